//! The command `pellicle` and the library's examples, as programs to run.

use crate::wgsl::root;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;
use tempfile::TempDir;

/// Path of a program of the workspace, built first if it is not up to date.
///
/// # Panics
/// When the build fails or there is no such program.
pub fn program(name: &str) -> &'static Path {
    static PROGRAMS: OnceLock<BTreeMap<String, PathBuf>> = OnceLock::new();
    let programs = PROGRAMS.get_or_init(build);
    programs
        .get(name)
        .unwrap_or_else(|| panic!("there is no program {name} among {:?}", programs.keys()))
}

/// Builds the programs the way this executable was built, which is `…/target/<profile>/deps/<name>`, so that what `cargo test`
/// has already compiled for the workspace is not compiled again.
fn build() -> BTreeMap<String, PathBuf> {
    let executable = std::env::current_exe().unwrap();
    let profile_folder = executable.parent().and_then(Path::parent).unwrap();
    let profile = match profile_folder.file_name().and_then(OsStr::to_str) {
        Some("debug") => "dev",
        Some(other) => other,
        None => panic!("{} is not in the folder of a profile", executable.display()),
    };
    let output = Command::new(env!("CARGO"))
        .current_dir(root())
        .args(["build", "--workspace", "--bin", "pellicle", "--examples"])
        .args(["--message-format", "json", "--profile", profile])
        .arg("--target-dir")
        .arg(profile_folder.parent().unwrap())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    cargo_metadata::Message::parse_stream(output.stdout.as_slice())
        .filter_map(|message| match message.unwrap() {
            cargo_metadata::Message::CompilerArtifact(artifact) => {
                let path = artifact.executable?.into_std_path_buf();
                Some((artifact.target.name, path))
            }
            _ => None,
        })
        .collect()
}

/// Result of running a program.
#[derive(Clone, Debug)]
pub struct Ran {
    /// Whether the exit code was 0.
    pub success: bool,
    /// Standard output.
    pub stdout: String,
    /// Standard error, without the lines that a driver writes when it finds no desktop.
    pub stderr: String,
}

impl Ran {
    /// # Panics
    /// When the output is not UTF-8, or the program panicked, which no test expects.
    pub fn of(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        let ours = |line: &&str| !line.contains("XDG_RUNTIME_DIR");
        let stderr = text(&output.stderr);
        assert!(!stderr.contains("panicked"), "{stderr}");
        assert!(
            output.status.code().is_some(),
            "was ended by a signal: {stderr}"
        );
        Self {
            success: output.status.success(),
            stdout: text(&output.stdout),
            stderr: stderr.split_inclusive('\n').filter(ours).collect(),
        }
    }

    /// # Panics
    /// When the program failed.
    #[must_use]
    pub fn succeeded(self) -> Self {
        assert!(self.success, "{}", self.stderr);
        self
    }

    /// The text that a failing program wrote to standard error.
    ///
    /// # Panics
    /// When it did not fail, or failed without a message.
    pub fn failed(self) -> String {
        assert!(!self.success, "did not fail: {}", self.stderr);
        assert!(!self.stderr.trim().is_empty());
        self.stderr
    }
}

/// An empty folder that the command runs in.
#[derive(Debug)]
pub struct Place(TempDir);

impl Default for Place {
    fn default() -> Self {
        Self(tempfile::tempdir().unwrap())
    }
}

impl Place {
    /// A file or folder in it.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// The names in it, hidden ones too, sorted.
    ///
    /// # Panics
    /// When the folder cannot be read.
    pub fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// The command with arguments, which are separated by spaces; it can still be changed before it runs.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(program("pellicle"));
        command
            .current_dir(self.0.path())
            .env_remove("RUST_BACKTRACE")
            .args(arguments.split_whitespace());
        command
    }

    /// Runs the command.
    ///
    /// # Panics
    /// When it panics.
    pub fn run(&self, arguments: &str) -> Ran {
        Ran::of(&self.command(arguments).output().unwrap())
    }

    /// Runs the command with `input` on its standard input.
    ///
    /// # Panics
    /// When it panics or cannot be started.
    pub fn run_with_input(&self, arguments: &str, input: &[u8]) -> Ran {
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
    ///
    /// # Panics
    /// When it panics.
    pub fn run_without_driver(&self, arguments: &str) -> Ran {
        let mut command = self.command(arguments);
        for variable in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"] {
            command.env(variable, self.path("no_such_driver.json"));
        }
        Ran::of(&command.output().unwrap())
    }
}
