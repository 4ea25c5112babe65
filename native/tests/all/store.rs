//! Compiled steps on disk: found again, bounded, and never another step's.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::thread;

use coadjoint_native::{COptions, Native, Store};
use coadjoint_program::Trajectories;
use tempfile::TempDir;

use crate::samples::{Chance, Sample, Seen, compare};

/// A folder with a store, and a compiler that counts how often it compiles.
struct Place {
    folder: TempDir,
    compiler: PathBuf,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let compiler = folder.path().join("compiler");
        let counts = folder.path().join("counts");
        let text = format!(
            "#!/bin/sh\n[ \"$1\" = --version ] || echo >> {}\nexec cc \"$@\"\n",
            counts.display()
        );
        fs::write(&compiler, text).unwrap();
        fs::set_permissions(&compiler, fs::Permissions::from_mode(0o755)).unwrap();
        Self { folder, compiler }
    }

    fn options(&self, most: u64) -> COptions {
        let store = Store::new(self.folder.path().join("store"), most);
        assert!(store.is_some());
        let compiler = Some(self.compiler.clone().into());
        COptions { compiler, store, ..COptions::default() }
    }

    fn compiled(&self) -> usize {
        fs::read_to_string(self.folder.path().join("counts")).map_or(0, |text| text.lines().count())
    }

    fn steps(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.folder.path().join("store")).unwrap();
        entries.map(|entry| entry.unwrap().path()).collect()
    }
}

/// Makes the step of a sample and compares its bits with the interpreter's.
fn make(seed: u64, options: &COptions) {
    let sample = Sample::small(seed);
    let native = Native::by_c(&sample.kernel, options).unwrap();
    compare(&sample, &native.entry, 3, &mut Chance(seed), &mut Seen::default());
}

#[test]
fn a_step_is_compiled_once_for_all_processes() {
    let place = Place::new();
    let options = place.options(1 << 20);
    assert!(Native::kept(&Sample::small(1).kernel, &options).is_none());
    make(1, &options);
    make(1, &options);
    make(1, &place.options(1 << 20));
    assert_eq!(place.compiled(), 1);
    assert!(Native::kept(&Sample::small(1).kernel, &options).is_some());
    // Another kernel, and other functions of the same.
    make(2, &options);
    let one = COptions { trajectories: Trajectories::One, ..options };
    Native::by_c(&Sample::small(1).kernel, &one).unwrap();
    assert_eq!((place.compiled(), place.steps().len()), (3, 3));
}

#[test]
fn steps_that_are_damaged_or_of_another_key_are_compiled_again() {
    let place = Place::new();
    let options = place.options(1 << 20);
    make(1, &options);
    let [step] = &place.steps()[..] else { panic!("{:?}", place.steps()) };
    let damage: [fn(&Path); 3] = [
        |step| fs::write(step.join("step.so"), "rubbish").unwrap(),
        |step| fs::write(step.join("key"), "another").unwrap(),
        |step| fs::remove_file(step.join("step.so")).unwrap(),
    ];
    for (count, damage) in damage.into_iter().enumerate() {
        damage(step);
        make(1, &options);
        assert_eq!(place.compiled(), count + 2);
    }
    // A compiler that was changed makes another step.
    let text = fs::read_to_string(&place.compiler).unwrap();
    fs::write(&place.compiler, text + "# newer\n").unwrap();
    make(1, &options);
    assert_eq!(place.compiled(), 5);
}

#[test]
fn the_oldest_steps_make_room_for_new_ones() {
    let place = Place::new();
    make(1, &place.options(1 << 30));
    let size = |step: &PathBuf| {
        let files = fs::read_dir(step).unwrap();
        files.map(|file| file.unwrap().metadata().unwrap().len()).sum::<u64>()
    };
    let two = size(&place.steps()[0]) * 5 / 2;
    let options = place.options(two);
    make(2, &options);
    // The first one is used again, so that the second one is the oldest.
    make(1, &options);
    make(3, &options);
    assert_eq!((place.compiled(), place.steps().len()), (3, 2));
    make(1, &options);
    assert_eq!(place.compiled(), 3);
    make(2, &options);
    assert_eq!(place.compiled(), 4);
}

#[test]
fn several_make_the_same_step_side_by_side() {
    let place = Place::new();
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| make(1, &place.options(1 << 20)));
        }
    });
    assert_eq!(place.steps().len(), 1);
    make(1, &place.options(1 << 20));
    assert!(place.compiled() <= 4);
}

#[test]
fn a_folder_that_others_can_write_to_is_no_store() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("store");
    fs::create_dir(&path).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o777)).unwrap();
    assert!(Store::new(path.clone(), 1).is_none());
    fs::set_permissions(&path, fs::Permissions::from_mode(0o700)).unwrap();
    assert!(Store::new(path, 1).is_some());
    assert!(Store::new("beside/this".into(), 1).is_none());
    assert!(Store::new("/proc/no/folder".into(), 1).is_none());
}
