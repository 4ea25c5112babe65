//! Systems that are written as headers.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use coadjoint_codegen::emit::c::{HeaderError, HeaderOptions, Language, header};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::{Integrator, Kick};
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::problem::Parameter;
use coadjoint_codegen::step::{Origin, Step};
use coadjoint_codegen::system::{self, Options, Parameters};

use coadjoint_program::Precision;

use crate::tools::{FLAGS_CPP, Tool, output};

/// A system and how it is written.
pub struct System {
    pub name: &'static str,
    /// The text of a system file, or its path from the root.
    pub text: &'static str,
    pub truncation: usize,
    pub chart: Chart,
    pub parameters: Parameters,
    pub language: Language,
    /// Its header is committed.
    pub golden: bool,
    /// Compilers take long for it.
    pub large: bool,
}

impl System {
    /// Written as C with its parameters substituted, in the exponential chart, and compared with no committed header.
    const fn new(name: &'static str, text: &'static str, truncation: usize) -> Self {
        let (chart, parameters) = (Chart::Exponential, Parameters::Substituted);
        let (language, golden, large) = (Language::C, false, false);
        Self { name, text, truncation, chart, parameters, language, golden, large }
    }

    const fn kept(self) -> Self {
        Self { parameters: Parameters::Kept, ..self }
    }

    const fn large(self) -> Self {
        Self { large: true, ..self }
    }

    const fn golden(self) -> Self {
        Self { golden: true, ..self }
    }

    const fn cayley(self) -> Self {
        Self { chart: Chart::Cayley, ..self }
    }

    const fn cpp(self) -> Self {
        Self { language: Language::Cpp, ..self }
    }
}

const SYSTEMS: &[System] = &[
    System::new("rigid_body", "examples/rigid_body.toml", 5).golden(),
    System::new("heavy_top", "examples/heavy_top.toml", 3).kept(),
    System::new("cayley_body", "tests/systems/cayley_body.toml", 3).cayley(),
    System::new("comoving_body", "tests/systems/comoving_body.toml", 3).kept(),
    System::new("three_wave", "tests/systems/three_wave.toml", 5).kept(),
    System::new("three_wave_cayley", "tests/systems/three_wave.toml", 3)
        .cayley()
        .kept()
        .cpp()
        .golden(),
    System::new("su3", "examples/su3_quadratic.toml", 3).large(),
    System::new("ring", "tests/systems/ring.toml", 3).large(),
    System::new("pendulum", "tests/systems/pendulum.toml", 5).kept(),
    System::new("satellite", "tests/systems/satellite.toml", 3).cpp(),
    System::new("plane_and_spin", "tests/systems/product.toml", 3),
    System::new("brackets", "tests/systems/rotations_by_brackets.toml", 3),
    System::new("relativistic_body", "examples/relativistic_body.toml", 5).kept(),
    System::new("six_variables", "tests/systems/six.toml", 3).cpp(),
    System::new("driven", "tests/systems/driven.toml", 5).kept(),
    System::new("driven_six", "tests/systems/driven_six.toml", 3).cpp(),
    System::new("kicked_root", "tests/systems/kicked_root.toml", 3).kept(),
];

/// All systems, built once.
pub fn all() -> &'static [Built] {
    static ALL: LazyLock<Vec<Built>> = LazyLock::new(|| SYSTEMS.iter().map(Built::new).collect());
    &ALL
}

/// A system with its header.
pub struct Built {
    pub system: &'static System,
    pub parameters: Vec<Parameter>,
    /// A step of it as programs.
    pub programs: Step,
    /// The step size.
    pub step: f64,
    pub momentum: Vec<f64>,
    /// True if steps accept every matrix as an element.
    pub any_element: bool,
    pub file: String,
    pub header: String,
    prefix: String,
}

/// True if a step accepts twice the neutral element.
fn any_element(programs: &Step) -> bool {
    let kernel = programs.kernel();
    let matrix = programs.kernel().programs.matrix.outputs().len().isqrt();
    let unit = |at: usize| if at / matrix == at % matrix { 1.0 } else { 0.0 };
    let unit: Vec<f64> = (0..matrix * matrix).map(unit).collect();
    let mut state: Vec<f64> = programs.element_of(&unit).iter().map(|entry| 2.0 * entry).collect();
    state.extend(vec![0.1; kernel.dim]);
    kernel.programs.sound.run(&state, &[]) == [1.0]
}

impl Built {
    pub fn new(system: &'static System) -> Self {
        let options = Options {
            parameters: system.parameters,
            truncation: Some(system.truncation),
            chart: Some(system.chart),
            ..Options::default()
        };
        let read = system::read_either(&text(system.text), options, &[]).unwrap();
        let (units, run) = (read.units, read.run);
        let mut origin = Origin::derive(read.problem, TermLimit::default()).unwrap();
        if let Some((potential, splitting)) = read.potential {
            origin = origin.with_kicks(Kick::build(potential), splitting).unwrap();
        }
        let facts = origin.facts();
        let style = HeaderOptions {
            language: system.language,
            prefix: facts.name.to_owned(),
            time: units.time.clone(),
            momentum: (0..facts.algebra.dim())
                .map(|i| units.coordinate(i).map(str::to_owned))
                .collect(),
            only_step: None,
        };
        let header = header(&origin, &style).unwrap();
        let prefix = coadjoint_codegen::emit::c::prefix(facts.name);
        let ending = if system.language == Language::Cpp { "hpp" } else { "h" };
        let programs = origin.step(Precision::Double).unwrap();
        Self {
            system,
            step: run.step.unwrap(),
            momentum: run.momentum.unwrap(),
            any_element: any_element(&programs),
            programs,
            file: format!("{prefix}.{ending}"),
            header,
            prefix,
            parameters: facts.parameters.to_vec(),
        }
    }

    fn fill(&self, template: &str) -> String {
        let parameters = &self.parameters;
        let with = !parameters.is_empty();
        let list: Vec<String> = self.momentum.iter().map(|value| format!("{value:?}")).collect();
        let declared = "    @p@_parameters parameters;\n    @p@_default_parameters(&parameters);";
        let broken = "    parameters.@first@ = (double)NAN;\n    \
            status = @p@_init(&broken, @step@, &parameters);\n    \
            printf(\"parameter %d %d\\n\", (int)status, (int)@p@_step(&broken, &state@time@));";
        let first = parameters.first().map_or("", |parameter| match parameter.name.as_str() {
            "double" => "double_",
            name => name,
        });
        let moves = self.programs.moves();
        let time = if moves { format!(", {:?}", super::TIME) } else { String::new() };
        template
            .replace("@parameters@", if with { declared } else { "" })
            .replace("@broken@", if with { broken } else { "" })
            .replace("@first@", first)
            .replace("@time@", &time)
            .replace("@passed@", if with { ", &parameters" } else { "" })
            .replace("@by_value@", if with { ", parameters" } else { "" })
            .replace("@file@", &self.file)
            .replace("@momentum@", &list.join(", "))
            .replace("@step@", &format!("{:?}", self.step))
            .replace("@steps@", &super::STEPS.to_string())
            .replace("@C@", &coadjoint_codegen::emit::camel_case(&self.prefix))
            .replace("@P@", &self.prefix.to_uppercase())
            .replace("@p@", &self.prefix)
    }

    fn write(&self, folder: &Path, name: &str, template: &str) -> PathBuf {
        std::fs::write(folder.join(&self.file), &self.header).unwrap();
        let source = folder.join(name);
        std::fs::write(&source, self.fill(template)).unwrap();
        source
    }

    /// The header and a program that drives it; its source.
    pub fn write_main(&self, folder: &Path) -> PathBuf {
        self.write(folder, "main.c", include_str!("main.c"))
    }

    /// The program's output as C++, where the class makes the same steps; nothing without a compiler.
    pub fn by_class(&self, folder: &Path) -> Vec<String> {
        let Some(compiler) = Tool::find("g++") else { return Vec::new() };
        let mut flags = FLAGS_CPP.to_vec();
        flags.extend(["-O2", "-ffp-contract=off"]);
        let main = self.write(folder, "main.cpp", include_str!("main.c"));
        compiler.compile(&flags, &main, &folder.join("functions"), &["-lm"]);
        let found = output(&folder.join("functions"), &[]);
        let class = self.write(folder, "class.cpp", include_str!("class.cpp"));
        compiler.compile(&flags, &class, &folder.join("class"), &["-lm"]);
        let by_class = output(&folder.join("class"), &[]);
        for line in by_class[0].lines().take(2) {
            assert!(found[0].contains(&format!("\n{line}\n")), "{line} in\n{}", found[0]);
        }
        assert!(by_class[0].ends_with("\n0 0\n"), "{}", by_class[0]);
        found
    }
}

fn text(text: &str) -> String {
    match text.ends_with(".toml") {
        true => std::fs::read_to_string(root().join(text)).unwrap(),
        false => text.to_owned(),
    }
}

/// The root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A file is what is written now, or becomes it.
pub fn check_golden(path: &str, text: &str) {
    let path = root().join(path);
    if std::env::var_os("COADJOINT_BLESS").is_some() {
        std::fs::write(&path, text).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "{} differs from what is written now", path.display());
}

/// The system of `examples/c`.
const TOUTATIS: System = System::new("toutatis", "examples/c/toutatis.toml", 7).golden();

/// It with its header.
pub fn toutatis() -> Built {
    Built::new(&TOUTATIS)
}

/// The header of a system file as it stands.
pub fn attempt(text: &str) -> Result<String, HeaderError> {
    let problem = system::read(text, Options::default()).unwrap().problem;
    let integrator = Integrator::build(problem, TermLimit::default()).unwrap();
    header(&Origin::from(integrator), &HeaderOptions::default())
}
