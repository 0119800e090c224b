//! The progress of a render: a line that is redrawn on a terminal, and nothing elsewhere.

use crate::print::percent;
use indicatif::{HumanCount, HumanDuration, ProgressBar, ProgressState, ProgressStyle};
use pellicle::progressive::Render;
use std::fmt::Write;

const COMPILING: &str = "{prefix}compiling shaders …";
const RENDERING: &str = "{prefix}{bar:32} {percent:>3} %{msg}{pace}";

/// The progress line, on standard error if that is a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    is_compiling: bool,
}

impl Progress {
    /// A line preceded by `heading`.
    pub(crate) fn new(heading: &str) -> Self {
        Self::on(ProgressBar::new(1), heading)
    }

    /// Sets the number of samples at the end.
    pub(crate) fn set_total(&self, samples: u64) {
        self.bar.set_length(samples);
    }

    /// Shows the noise of a render, and how far it is.
    pub(crate) fn set_state(&self, render: &Render) {
        let done = render.done();
        self.set_total(done + render.work_left());
        self.bar.set_position(done);
        if let Some(noise) = render.noise() {
            self.bar.set_message(format!("  noise {}", percent(noise)));
        }
    }

    fn on(bar: ProgressBar, heading: &str) -> Self {
        let bar = bar.with_style(style(RENDERING));
        Self {
            bar: bar.with_prefix(heading.to_owned()),
            is_compiling: false,
        }
    }

    /// Shows how many samples are done; 0 means that shaders are being compiled.
    pub(crate) fn update(&mut self, done: u64) {
        if done == 0 {
            self.is_compiling = true;
            self.bar.set_style(style(COMPILING));
            self.bar.tick();
        } else {
            self.bar.set_position(done);
            if self.is_compiling {
                self.is_compiling = false;
                self.start_bar();
            }
        }
    }

    /// Starts the bar. The first batch may have waited for the driver, so the pace is that of the others.
    fn start_bar(&self) {
        // The tick records the current position, and the estimate restarts from there.
        self.bar.tick();
        self.bar.reset_eta();
        self.bar.set_style(style(RENDERING));
        self.bar.force_draw();
    }

    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    let style = ProgressStyle::with_template(template);
    let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
    style.with_key("pace", write_pace)
}

/// Writes samples per second and time left, once they are known.
fn write_pace(state: &ProgressState, out: &mut dyn Write) {
    let per_second = state.per_sec() as u64;
    if per_second > 0 {
        // The width of the numbers is bounded, so a failure to write can only come from the terminal itself.
        let _ = write!(
            out,
            "  {} samples/s  {:#} left",
            HumanCount(per_second),
            HumanDuration(state.eta())
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use indicatif::{ProgressDrawTarget, TermLike};
    use std::io;
    use std::sync::{Arc, Mutex};
    use std::time::{Duration, Instant};

    /// A terminal that keeps all states of its one line.
    #[derive(Clone, Debug, Default)]
    struct Screen(Arc<Mutex<Vec<String>>>);

    impl Screen {
        fn lines(&self) -> Vec<String> {
            let lines = self.0.lock().unwrap();
            lines.iter().map(|line| line.trim().to_owned()).collect()
        }

        fn line(&self) -> String {
            self.lines().pop().unwrap_or_default()
        }
    }

    impl TermLike for Screen {
        fn width(&self) -> u16 {
            100
        }
        fn move_cursor_up(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_down(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_right(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn move_cursor_left(&self, _: usize) -> io::Result<()> {
            Ok(())
        }
        fn write_line(&self, text: &str) -> io::Result<()> {
            self.write_str(text)
        }
        fn write_str(&self, text: &str) -> io::Result<()> {
            let mut lines = self.0.lock().unwrap();
            match lines.last_mut() {
                Some(line) => line.push_str(text),
                None => lines.push(text.to_owned()),
            }
            Ok(())
        }
        fn clear_line(&self) -> io::Result<()> {
            self.0.lock().unwrap().push(String::new());
            Ok(())
        }
        fn flush(&self) -> io::Result<()> {
            Ok(())
        }
    }

    fn on_a_screen() -> (Progress, Screen) {
        let screen = Screen::default();
        let target = ProgressDrawTarget::term_like_with_hz(Box::new(screen.clone()), 255);
        let bar = ProgressBar::with_draw_target(Some(1000), target);
        (Progress::on(bar, "frame 3, "), screen)
    }

    fn wait() {
        std::thread::sleep(Duration::from_millis(50));
    }

    #[test]
    fn a_compile_shows_until_the_first_batch_is_done() {
        let (mut progress, screen) = on_a_screen();
        progress.update(0);
        assert_eq!(screen.line(), "frame 3, compiling shaders …");
        wait();
        progress.update(100);
        let line = screen.line();
        assert!(
            line.starts_with("frame 3, █") && line.ends_with("10 %"),
            "{line}"
        );
        for line in screen.lines() {
            let is_blank = line.is_empty();
            let is_compiling = line.ends_with("compiling shaders …");
            assert!(is_blank || is_compiling || line.ends_with("10 %"), "{line}");
        }
        wait();
        progress.update(200);
        wait();
        progress.bar.force_draw();
        let line = screen.line();
        assert!(line.contains("20 %") && line.ends_with("left"), "{line}");
    }

    #[test]
    fn the_time_left_does_not_count_the_compile() {
        let (mut progress, _) = on_a_screen();
        progress.update(0);
        std::thread::sleep(Duration::from_millis(600));
        progress.update(1);
        let started = Instant::now();
        for done in 2..12 {
            std::thread::sleep(Duration::from_millis(5));
            progress.update(done);
        }
        progress.bar.tick();
        let (pace, seconds) = (progress.bar.per_sec(), started.elapsed().as_secs_f64());
        assert!(
            pace > 0.5 * 10.0 / seconds,
            "{pace} samples/s in {seconds} s"
        );
    }

    #[test]
    fn without_a_compile_there_is_the_bar_at_once() {
        let (mut progress, screen) = on_a_screen();
        wait();
        progress.update(500);
        progress.bar.force_draw();
        let line = screen.line();
        assert!(
            line.contains("50 %") && !line.contains("compiling"),
            "{line}"
        );
        progress.clear();
        assert_eq!(screen.line(), "");
    }
}
