//! What the figures were taken on.

/// The machine and the target the program was built for.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Machine {
    /// The processor's own name, where the system tells it.
    pub processor: String,
    /// Logical processors.
    pub cores: usize,
    /// Operating system and architecture.
    pub system: String,
    /// Vector features the program was compiled with.
    pub features: Vec<&'static str>,
    /// Load averages over 1, 5 and 15 minutes at the start, where the system tells them.
    pub load: String,
}

impl Machine {
    /// This machine, now.
    #[must_use]
    pub fn here() -> Self {
        let compiled = [
            ("sse2", cfg!(target_feature = "sse2")),
            ("avx", cfg!(target_feature = "avx")),
            ("avx2", cfg!(target_feature = "avx2")),
            ("fma", cfg!(target_feature = "fma")),
            ("avx512f", cfg!(target_feature = "avx512f")),
            ("neon", cfg!(target_feature = "neon")),
        ];
        Self {
            processor: processor().unwrap_or_else(|| "unknown processor".to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            system: format!("{} {}", std::env::consts::OS, std::env::consts::ARCH),
            features: compiled
                .into_iter()
                .filter(|(_, present)| *present)
                .map(|(name, _)| name)
                .collect(),
            load: std::fs::read_to_string("/proc/loadavg")
                .map(|text| text.split_whitespace().take(3).collect::<Vec<_>>().join(" "))
                .unwrap_or_default(),
        }
    }
}

fn processor() -> Option<String> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let field = |key: &str| {
        let line = text
            .lines()
            .find(|line| line.split(':').next().is_some_and(|name| name.trim() == key))?;
        line.split(':').nth(1).map(|value| value.trim().to_owned())
    };
    let name = field("model name")?;
    // Some virtual machines give a vendor's name only; family and model tell more.
    Some(match (field("cpu family"), field("model")) {
        (Some(family), Some(model)) => format!("{name} (family {family}, model {model})"),
        _ => name,
    })
}

impl std::fmt::Display for Machine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "{}, {} cores, {}; built with {}",
            self.processor,
            self.cores,
            self.system,
            self.features.join(" ")
        )?;
        if self.load.is_empty() { Ok(()) } else { write!(f, "; load {}", self.load) }
    }
}
