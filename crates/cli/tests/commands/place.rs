//! Running the command in a folder of its own.

use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// The command.
pub(crate) const PELLICLE: &str = env!("CARGO_BIN_EXE_pellicle");

/// Result of running a program.
#[derive(Clone, Debug)]
pub(crate) struct Ran {
    /// Whether the exit code was 0.
    pub(crate) success: bool,
    /// The exit code.
    pub(crate) code: i32,
    /// Standard output.
    pub(crate) stdout: String,
    /// Standard error, without the lines that a driver writes when it finds no desktop.
    pub(crate) stderr: String,
}

impl Ran {
    /// The output, which must be UTF-8, of a program that did not panic.
    pub(crate) fn of(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        let ours = |line: &&str| !line.contains("XDG_RUNTIME_DIR");
        let stderr = text(&output.stderr);
        assert!(!stderr.contains("panicked"), "{stderr}");
        let Some(code) = output.status.code() else {
            panic!("was ended by a signal: {stderr}");
        };
        Self {
            success: output.status.success(),
            code,
            stdout: text(&output.stdout),
            stderr: stderr.split_inclusive('\n').filter(ours).collect(),
        }
    }

    /// The same, of a program that did not fail.
    #[must_use]
    pub(crate) fn succeeded(self) -> Self {
        assert!(self.success, "{}", self.stderr);
        self
    }

    /// The text that a failing program wrote to standard error.
    pub(crate) fn failed(self) -> String {
        assert!(!self.success, "did not fail: {}", self.stderr);
        assert!(!self.stderr.trim().is_empty());
        self.stderr
    }
}

/// An empty folder that the command runs in.
#[derive(Debug)]
pub(crate) struct Place(TempDir);

impl Default for Place {
    fn default() -> Self {
        Self(tempfile::tempdir().unwrap())
    }
}

impl Place {
    /// A file or folder in it.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The names in it, hidden ones too, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// The command with arguments, which are separated by spaces; it can still be changed before it runs.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(PELLICLE);
        command
            .current_dir(self.0.path())
            .env_remove("RUST_BACKTRACE")
            .args(arguments.split_whitespace());
        command
    }

    /// Runs the command.
    pub(crate) fn run(&self, arguments: &str) -> Ran {
        Ran::of(&self.command(arguments).output().unwrap())
    }

    /// Runs `film` with a stack, which may contain spaces.
    pub(crate) fn film(&self, stack: &str, arguments: &str) -> Ran {
        let mut command = self.command("film");
        command.arg(stack).args(arguments.split_whitespace());
        Ran::of(&command.output().unwrap())
    }

    /// Runs the command with `input` on its standard input.
    pub(crate) fn run_with_input(&self, arguments: &str, input: &[u8]) -> Ran {
        let mut command = self.command(arguments);
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        // A command that does not read it to the end closes the pipe.
        let _ = child.stdin.take().unwrap().write_all(input);
        Ran::of(&child.wait_with_output().unwrap())
    }

    /// Runs the command in an environment without a driver.
    pub(crate) fn run_without_driver(&self, arguments: &str) -> Ran {
        let mut command = self.command(arguments);
        for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(variable, self.path("no_such_driver.json"));
        }
        Ran::of(&command.output().unwrap())
    }
}
