//! What is written to standard output: by a second process of this program, whose output a test can read.

use std::io::Write;
use std::path::Path;
use std::process::Command;

use pellicle_picture_file::{PendingFile, STANDARD_OUTPUT};

/// Set in the second process.
const WRITES: &str = "PELLICLE_TEST_WRITES";
/// Bytes that are no text.
const PICTURE: &[u8] = b"\x00\xff\npicture\r\n\xfe";

#[test]
fn standard_output_gets_all_bytes_when_they_are_complete() {
    if std::env::var_os(WRITES).is_some() {
        let create = || PendingFile::create(Path::new(STANDARD_OUTPUT)).unwrap();
        let (finished, dropped) = (create(), create());
        dropped.handle().unwrap().write_all(b"half").unwrap();
        finished.handle().unwrap().write_all(PICTURE).unwrap();
        drop(dropped);
        return finished.commit().unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    let mut second = Command::new(std::env::current_exe().unwrap());
    second.env(WRITES, "1").env("TMPDIR", folder.path());
    let output = second.current_dir(folder.path()).output().unwrap();
    assert!(output.status.success());
    // Among the words of the test harness.
    let has = |bytes: &[u8]| output.stdout.windows(bytes.len()).any(|part| part == bytes);
    assert!(has(PICTURE) && !has(b"half"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
