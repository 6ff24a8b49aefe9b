//! Running the program in a folder of its own.

use serde_json::Value;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A folder for one test, empty at first.
pub(crate) struct Folder(PathBuf);

impl Folder {
    /// The folder of this name; each test has its own.
    pub(crate) fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        Self(folder)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// Writes a file.
    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.0.join(name), bytes).unwrap();
    }

    /// Reads a file.
    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap()
    }

    /// The names of the files in it, or in a folder of it, sorted.
    pub(crate) fn files(&self, name: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.join(name)).unwrap();
        let mut names: Vec<_> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Runs the program.
    pub(crate) fn cotama(&self, arguments: &[&str]) -> Ended {
        ended(self.command(env!("CARGO_BIN_EXE_cotama")).args(arguments))
    }

    /// Runs a line of a shell in which `cotama` is the program.
    pub(crate) fn shell(&self, line: &str) -> Ended {
        ended(self.command("sh").args(["-c", line]))
    }

    fn command(&self, program: impl AsRef<OsStr>) -> Command {
        let mut command = Command::new(program);
        let own = Path::new(env!("CARGO_BIN_EXE_cotama")).parent().unwrap().to_owned();
        let path = std::env::var_os("PATH").unwrap_or_default();
        let path =
            std::env::join_paths([own].into_iter().chain(std::env::split_paths(&path))).unwrap();
        command.current_dir(&self.0).env("PATH", path).env("COLUMNS", "100").stdin(Stdio::null());
        for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
            command.env_remove(name);
        }
        command
    }
}

fn ended(command: &mut Command) -> Ended {
    let output = command.output().unwrap();
    Ended {
        code: output.status.code(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

/// How the program ended.
#[derive(Debug)]
pub(crate) struct Ended {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Ended {
    /// The JSON object on standard output, which is as the stored schema of its command says;
    /// `code` is the exit code.
    pub(crate) fn json(&self, code: i32) -> Value {
        assert_eq!(self.code, Some(code), "{self:?}");
        assert!(self.stdout.starts_with("{\n  \"schema\": \"cotama/"), "{}", self.stdout);
        let answer: Value = serde_json::from_str(&self.stdout).unwrap();
        let command = answer["schema"].as_str().unwrap().split('/').nth(1).unwrap();
        crate::schemas::validate(command, &answer);
        answer
    }
}

/// Compares with a golden file.
pub(crate) fn golden(name: &str, said: &str) {
    cotama_golden::compare(Path::new("tests/golden").join(name), said);
}

/// The text of the patrol, with each `(old, new)` replaced where it stands first.
pub(crate) fn patrol(edits: &[(&str, &str)]) -> String {
    let text = cotama_models::missions::embedded::mission("patrol").unwrap().text.to_owned();
    edits.iter().fold(text, |text, (old, new)| {
        assert!(text.contains(old), "{old:?} is not in the patrol");
        text.replacen(old, new, 1)
    })
}
