//! `render --watch`: again when a file changes.

use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant, SystemTime};

use tyndall_tests::{Desk, SCENE};

use crate::run::Program;

/// Ends the program with the test, whichever way that ends.
struct Watching(Child);

impl Drop for Watching {
    fn drop(&mut self) {
        // It may have ended by itself, which the test has noticed by then.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn written(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|data| data.modified()).ok()
}

fn wait_for(what: &str, child: &mut Watching, done: impl Fn() -> bool) {
    let start = Instant::now();
    while !done() {
        assert!(child.0.try_wait().unwrap().is_none(), "{what}: it has ended");
        assert!(start.elapsed() < Duration::from_secs(60), "{what} does not happen");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_changed_scene_is_drawn_again_and_a_mistake_does_not_end_it() {
    let desk = Desk::new();
    let arguments = ["render", "fog.graph.ron", "--size", "8x8", "--watch", "--output", "radiance=a.npy"];
    let picture = desk.path("a.npy");
    let child = desk.command(&arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    let mut child = Watching(child);
    wait_for("the first picture", &mut child, || picture.exists());
    // The files are watched only after the first picture is written.
    std::thread::sleep(Duration::from_millis(700));

    let (first, time) = (std::fs::read(&picture).unwrap(), written(&picture));
    desk.put("test.scene.ron", "(");
    std::thread::sleep(Duration::from_millis(700));
    assert_eq!(written(&picture), time, "a broken scene changes nothing");

    desk.put("test.scene.ron", &SCENE.replace("20.0, 18.0, 15.0", "40.0, 36.0, 30.0"));
    wait_for("the second picture", &mut child, || written(&picture) != time);
    assert_ne!(std::fs::read(&picture).unwrap(), first);
}
