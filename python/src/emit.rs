//! Systems and models as code.

use std::path::Path;

use coadjoint_codegen::emit::c::Language;
use coadjoint_program::{Precision, print::DeviceLanguage};
use coadjoint_run::{RunError, emit};

/// The code of a system or a model in this language.
pub fn emitted(
    name: &str,
    source: emit::Emittable,
    language: &str,
    prefix: Option<String>,
    step: Option<f64>,
    single: bool,
) -> Result<String, RunError> {
    let path = Path::new(name);
    let precision = if single { Precision::Single } else { Precision::Double };
    match language {
        "rust" => emit::rust(path, source),
        "c" => emit::header(path, source, Language::C, prefix),
        "cpp" => emit::header(path, source, Language::Cpp, prefix),
        "opencl" => emit::kernel(path, source, step, precision, DeviceLanguage::OpenCl),
        "cuda" => emit::kernel(path, source, step, precision, DeviceLanguage::Cuda),
        _ => Err(RunError::Option(format!(
            "language=\"{language}\": there are \"rust\", \"c\", \"cpp\", \"opencl\" and \"cuda\""
        ))),
    }
}
