//! What a signal leaves behind. Alone in its program, since it removes the temporary files of all threads.

use std::fs;
use std::io::Write;
use std::sync::mpsc;
use std::time::Duration;

use pellicle_picture_file::{PendingFile, abandon_all};

#[test]
fn all_temporary_files_are_removed_and_none_is_created_or_renamed() {
    let folder = tempfile::tempdir().unwrap();
    let count = || fs::read_dir(folder.path()).unwrap().count();
    let create = |name: &str| PendingFile::create(&folder.path().join(name)).unwrap();
    create("finished").commit().unwrap();
    let (pending, lost) = (create("pending"), create("lost"));
    pending.handle().unwrap().write_all(b"half").unwrap();
    assert_eq!(count(), 3);

    let abandoned = abandon_all();
    assert_eq!(count(), 1);
    let (sender, ended) = mpsc::channel();
    let path = folder.path().join("late");
    let commit = sender.clone();
    let threads = [
        std::thread::spawn(move || commit.send(pending.commit().is_ok())),
        std::thread::spawn(move || sender.send(PendingFile::create(&path).is_ok())),
    ];
    assert!(ended.recv_timeout(Duration::from_millis(200)).is_err());
    assert_eq!(count(), 1);

    // If the process goes on after all, files are created again, and what was removed cannot be finished.
    drop(abandoned);
    for thread in threads {
        thread.join().unwrap().unwrap();
    }
    let mut results: Vec<bool> = ended.iter().collect();
    results.sort_unstable();
    assert_eq!(results, [false, true]);
    assert!(lost.commit().is_err());
    assert_eq!(count(), 1);
}
