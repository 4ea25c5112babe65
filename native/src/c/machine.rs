//! The identity of the processor: code for one may not run on another that shares the folder.

use std::collections::BTreeSet;

/// A description of the processor and its instructions, the same for equal processors; `None` where the system does not
/// tell.
pub(super) fn processor() -> Option<String> {
    #[cfg(any(target_os = "linux", target_os = "android"))]
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    #[cfg(target_os = "macos")]
    let text = {
        let mut command = std::process::Command::new("/usr/sbin/sysctl");
        let output = command.args(["machdep.cpu", "hw.optional"]).output().ok()?;
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    #[cfg(not(any(target_os = "linux", target_os = "android", target_os = "macos")))]
    let text = String::new();
    Some(describe(&text)).filter(|description| !description.is_empty())
}

/// The lines that tell of what a processor is, each once, in order; not those of its frequency or its number.
fn describe(text: &str) -> String {
    const TELLING: [&str; 16] = [
        "vendor_id",
        "cpu family",
        "model",
        "model name",
        "stepping",
        "flags",
        "features",
        "isa",
        "cpu implementer",
        "cpu architecture",
        "cpu variant",
        "cpu part",
        "cpu",
        "machdep.cpu",
        "hw.optional",
        "uarch",
    ];
    let telling = |line: &&str| {
        let name = line.split([':', '=']).next().unwrap_or_default().trim().to_lowercase();
        TELLING.contains(&name.as_str())
            || name.starts_with("machdep.cpu.")
            || name.starts_with("hw.optional.")
    };
    let lines: BTreeSet<&str> = text.lines().map(str::trim).filter(telling).collect();
    lines.into_iter().collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::describe;

    #[test]
    fn what_changes_from_run_to_run_is_left_out() {
        let one = "processor\t: 0\nmodel name\t: A\ncpu MHz\t: 1.0\nflags\t: fma avx2\n\n\
                   processor\t: 1\nmodel name\t: A\ncpu MHz\t: 2.0\nflags\t: fma avx2\n";
        assert_eq!(describe(one), "flags\t: fma avx2\nmodel name\t: A");
        assert_eq!(
            describe("Features : asimd\nCPU part : 0xd40\nBogoMIPS : 50.0"),
            "CPU part : 0xd40\nFeatures : asimd"
        );
        assert_ne!(describe("flags : fma"), describe("flags : fma avx512f"));
        assert_eq!(describe(""), "");
    }
}
