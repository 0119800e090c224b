//! Renders a picture that fits into memory, in rounds of samples of all its pixels.

use super::keeper::Keeper;
use super::{Job, Outcome, advance};
use crate::interrupt;
use crate::print;
use crate::progress::Progress;
use miette::IntoDiagnostic;
use pellicle::progressive::{Render, adaptive};
use pellicle::scene::Scene;
use pellicle::spectra::Round;
use pellicle::{RenderError, Session};
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Renders until the goal is reached, a signal comes or the device fails, and writes what was reached in any case.
pub(super) fn run(job: &Job<'_>) -> miette::Result<Outcome> {
    let _awaited = interrupt::Awaited::new();
    let mut progress = Progress::new(job.heading);
    let (mut session, mut render) = begin(job, &mut progress)?;
    let (before, started) = (render.done(), Instant::now());
    let mut keeper = job.keeper();
    let rendered = rounds(job, &mut session, &mut render, &mut progress, &mut keeper);
    let seconds = started.elapsed().as_secs_f64();
    progress.clear();
    let rendered = rendered.into_diagnostic();
    if render.done() == 0 {
        return rendered.map(|()| Outcome::Finished);
    }
    // The state is kept before anything else can fail.
    let kept = keeper.map_or(Ok(()), |keeper| keeper.finish(&render));
    job.print_speed(&render, render.done() - before, seconds);
    let stopped_by = match (&rendered, render.end()) {
        (Err(_), _) => "failure".to_owned(),
        (_, Some(end)) => end.to_string(),
        (_, None) => "signal".to_owned(),
    };
    let written = job.write(&render, stopped_by);
    if rendered.is_err() {
        print::note(job.how_to_resume(&render));
    }
    print::all_but_last([kept, written, rendered])?;
    match (render.end(), interrupt::signal()) {
        (None, Some(signal)) => {
            print::note(job.how_to_resume(&render));
            Ok(Outcome::Interrupted(signal))
        }
        _ => Ok(Outcome::Finished),
    }
}

/// Prepares the scene, and goes on from a checkpoint or begins anew.
fn begin<'a>(job: &Job<'a>, progress: &mut Progress) -> miette::Result<(Session<'a>, Render)> {
    let endurance = job.endurance;
    let mut render = match &endurance.checkpoint {
        Some(path) if endurance.resume && path.try_exists().into_diagnostic()? => {
            let of = (job.empty(job.window), job.goal);
            let render = Render::resume(of, path, &job.identity).into_diagnostic()?;
            let level = render.level();
            print::note(format_args!(
                "{}going on from {} at {level} samples per pixel",
                job.heading,
                path.display(),
            ));
            render
        }
        _ => Render::new(job.empty(job.window), job.goal),
    };
    if endurance.adaptive && !render.is_adaptive() {
        let (plan, is_mixed) = plan(job, progress)?;
        render = render.with_plan(plan);
        if is_mixed {
            render.mix();
        }
    }
    let session = session(job, job.scene, progress)?;
    progress.set_state(&render);
    if let Some(interval) = endurance.shortest_interval() {
        render.limit_rounds(interval.as_secs_f64());
    }
    Ok((session, render))
}

/// Prepares a scene; drivers may take seconds to compile it.
pub(super) fn session<'a>(
    job: &Job<'_>,
    scene: &'a Scene,
    progress: &mut Progress,
) -> miette::Result<Session<'a>> {
    let session = Session::new(job.renderer, scene, &mut |done| {
        progress.update(done);
        ControlFlow::Continue(())
    });
    let mut session = session.into_diagnostic()?;
    for &(fault, round) in &job.endurance.inject_fault {
        session.inject(fault, round);
    }
    Ok(session.allow_cpu(job.endurance.allow_cpu))
}

/// Decides with a pilot how many samples the tiles get. Returns whether the CPU had to help.
fn plan(job: &Job<'_>, progress: &mut Progress) -> miette::Result<(Vec<u32>, bool)> {
    let seed = adaptive::pilot_seed(job.scene.settings().seed);
    let scene = job.scene.with_seed(seed);
    let mut session = session(job, &scene, progress)?;
    let mut pilot = job.empty(job.window);
    let rounds = pilot.rounds_to(pilot.window(), adaptive::pilot_samples(job.goal.samples));
    advance(&mut session, &mut pilot, &rounds, &mut |_| ()).into_diagnostic()?;
    let plan = adaptive::plan(&pilot, job.goal.samples);
    Ok((plan, session.has_left_gpu()))
}

/// Takes rounds until the end or a signal.
fn rounds(
    job: &Job<'_>,
    session: &mut Session<'_>,
    render: &mut Render,
    progress: &mut Progress,
    keeper: &mut Option<Keeper>,
) -> Result<(), RenderError> {
    let mut preview = job.endurance.preview_every.map(Preview::new);
    while let Some(rounds) = render.next_rounds() {
        if render.level() > 0 && interrupt::signal().is_some() {
            break;
        }
        let (done, started) = (render.done(), Instant::now());
        let mut update = |more| progress.update(done + more);
        let advanced = advance(session, render.accumulation_mut(), &rounds, &mut update);
        if session.has_left_gpu() {
            render.mix();
        }
        advanced?;
        let work: u64 = rounds.iter().map(Round::work).sum();
        render.finish_round(work, started.elapsed().as_secs_f64());
        progress.set_state(render);
        if done == 0 {
            print_estimate(job, render);
        }
        if render.end().is_none() {
            if let Some(keeper) = keeper {
                keeper.after_round(render);
            }
            if let Some(preview) = &mut preview {
                preview.after_round(job, render);
            }
        }
    }
    Ok(())
}

/// The shortest render whose time is estimated.
const LONG_S: f64 = 10.0;

/// Says after the first round how long the render will take, where no line shows it all the time.
fn print_estimate(job: &Job<'_>, render: &Render) {
    let seconds = render.seconds_left().filter(|&seconds| seconds > LONG_S);
    if let (Some(seconds), false) = (seconds, std::io::stderr().is_terminal()) {
        let left = humantime::format_duration(Duration::from_secs(seconds as u64));
        print::note(format_args!("{}about {left} left", job.heading));
    }
}

/// Writes the pictures again and again.
struct Preview {
    every: Duration,
    last: Instant,
}

impl Preview {
    fn new(every: Duration) -> Self {
        Self {
            every,
            last: Instant::now(),
        }
    }

    /// Writes the pictures if it is time. A failure is reported, and the render goes on.
    fn after_round(&mut self, job: &Job<'_>, render: &Render) {
        if self.last.elapsed() < self.every {
            return;
        }
        if let Err(error) = job.write_pictures(render.accumulation(), true) {
            print::note(format_args!(
                "warning: no preview: {}",
                print::in_a_line(&error)
            ));
        }
        self.last = Instant::now();
    }
}
