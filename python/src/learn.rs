//! Learned maps.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;

use coadjoint_learn::data::RowPolicy;
use coadjoint_learn::network::{Progress, TrainingOptions};
use coadjoint_learn::table;
use coadjoint_learn::{Dataset, Kind, ModelFile, Request};
use coadjoint_run::simulate::{Schedule, Setup, run_model};
use coadjoint_run::{RunError, emit, learned, read_group, series};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::control::work;
use crate::emit::emitted;
use crate::error::{raised, refused};
use crate::outcome::result_of;
use crate::record::{Keeper, Trace};
use crate::system::Core;

/// Named columns of numbers.
type Named<'py> = Vec<(String, PyReadonlyArray1<'py, f64>)>;

/// The options of a fit.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Settings {
    group: String,
    /// The text of a system file whose group it is, in place of a name of the catalogue.
    algebra: Option<String>,
    chart: String,
    step: f64,
    kind: String,
    degree: Option<usize>,
    ridge: f64,
    tolerance: f64,
    drop: bool,
    start: Option<Vec<f64>>,
    seed: u64,
    widths: Vec<usize>,
    evaluations: usize,
    drift_steps: usize,
}

impl Settings {
    fn request(self, py: Python<'_>) -> PyResult<Request> {
        let kind = match self.kind.as_str() {
            "auto" => Kind::Auto,
            "polynomial" => Kind::Polynomial,
            "gp" => Kind::GaussianProcess,
            "network" => Kind::Network,
            "hybrid" => Kind::Hybrid,
            other => {
                let what = "there are \"auto\", \"polynomial\", \"gp\", \"network\" and \"hybrid\"";
                return Err(refused(py, format!("model=\"{other}\": {what}")));
            }
        };
        if !["exp", "cayley"].contains(&self.chart.as_str()) {
            let what = "there are \"exp\" and \"cayley\"";
            return Err(refused(py, format!("chart=\"{}\": {what}", self.chart)));
        }
        let group = match &self.algebra {
            Some(text) => read_group("group", text).map_err(|error| raised(py, &error))?,
            None => self.group.into(),
        };
        Ok(Request {
            group,
            chart: self.chart,
            step: self.step,
            kind,
            degree: self.degree,
            ridge: self.ridge,
            tolerance: Some(self.tolerance),
            policy: if self.drop { RowPolicy::Drop } else { RowPolicy::Refuse },
            start: self.start,
            seed: self.seed,
            network: TrainingOptions {
                widths: self.widths,
                ..TrainingOptions::budget(self.evaluations)
            },
            drift_steps: self.drift_steps,
        })
    }
}

fn columns(named: Named<'_>) -> Vec<(String, Vec<f64>)> {
    named.into_iter().map(|(name, values)| (name, values.as_array().to_vec())).collect()
}

/// Learns a map from columns: the model as text, and a summary as JSON.
#[pyfunction]
pub fn learn<'py>(
    py: Python<'py>,
    data: Named<'py>,
    test: Option<Named<'py>>,
    settings: Settings,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<(String, String)> {
    let request = settings.request(py)?;
    let (data, test) = (columns(data), test.map(columns));
    let made = work(py, progress.as_ref(), move |control| -> Result<_, RunError> {
        let mut told = |Progress { step, total, .. }: Progress| {
            control.total.store(total as u64, Ordering::Relaxed);
            control.done.store(step as u64, Ordering::Relaxed);
        };
        let table = |columns| table::Table::of_columns(Path::new("the data"), columns);
        let source = Dataset { data: table(data)?, test: test.map(table).transpose()? };
        let (file, summary) = coadjoint_learn::learn(&request, source, &mut told)?;
        let unwritten = |error: &dyn std::fmt::Display| RunError::Option(error.to_string());
        let text = file.text().map_err(|error| unwritten(&error))?;
        let summary = serde_json::to_string(&summary).map_err(|error| unwritten(&error))?;
        Ok((text, summary))
    })?;
    made.map_err(|error| raised(py, &error))
}

/// A learned map; never changed.
#[pyclass(frozen, module = "coadjoint._core")]
pub struct ModelCore {
    name: String,
    model: Arc<ModelFile>,
}

#[pymethods]
impl ModelCore {
    /// Reads the text of a model file.
    #[new]
    fn new(py: Python<'_>, text: String, name: String) -> PyResult<Self> {
        let made = work(py, None, move |_| {
            let model = Arc::new(ModelFile::of_text(Path::new(&name), &text)?);
            Ok(Self { name, model })
        })?;
        made.map_err(|error| raised(py, &RunError::Learn(error)))
    }

    /// Facts about the model.
    fn facts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let facts = PyDict::new(py);
        let algebra = self.model.group.algebra();
        let algebra = algebra.map_err(|error| raised(py, &RunError::Learn(error)))?;
        facts.set_item("group", self.model.group.name())?;
        facts.set_item("dimension", algebra.dim())?;
        facts.set_item("chart", &self.model.chart)?;
        facts.set_item("step", self.model.step)?;
        facts.set_item("attitude", self.model.attitude)?;
        facts.set_item("kind", self.model.model.name())?;
        facts.set_item("choice", &self.model.training.choice)?;
        Ok(facts)
    }

    /// A trajectory of the learned map; as that of a system.
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        momentum: PyReadonlyArray1<'py, f64>,
        time: f64,
        every: u64,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let momentum = momentum.as_array().to_vec();
        let (model, name) = (self.model.clone(), self.name.clone());
        let made = work(py, progress.as_ref(), move |control| -> Result<_, RunError> {
            let schedule = Schedule::of_model(model.step, time)?;
            control.total.store(schedule.steps, Ordering::Relaxed);
            let setup =
                Setup { recording: true, every: Some(every), ..Setup::new(schedule, momentum) };
            let mut keeper = Keeper { table: Trace::default(), control };
            let outcome = run_model(Path::new(&name), &model, &setup, &mut keeper)?;
            let label = format!("learned {}, {}", model.model.name(), model.chart);
            Ok((keeper.table, outcome, schedule, label))
        })?;
        let (table, outcome, schedule, label) = made.map_err(|error| raised(py, &error))?;
        let found = result_of(py, table, &outcome, &schedule)?;
        found.set_item("label", label)?;
        Ok(found)
    }

    /// The system whose steps, of the model's size, are the learned map.
    fn system(&self, py: Python<'_>) -> PyResult<Core> {
        let system = learned(&self.model).map_err(|error| raised(py, &error))?;
        Ok(Core::of(self.name.clone(), "".into(), system))
    }

    /// The number of applications of the map until this time.
    fn steps(&self, py: Python<'_>, time: f64) -> PyResult<u64> {
        let schedule = Schedule::of_model(self.model.step, time);
        Ok(schedule.map_err(|error| raised(py, &error))?.steps)
    }

    /// S of a learned polynomial.
    fn generating_function(&self, py: Python<'_>) -> PyResult<String> {
        series::learned(&self.model).map_err(|error| raised(py, &error))
    }

    /// A learned polynomial as code.
    fn emit(
        &self,
        py: Python<'_>,
        language: &str,
        prefix: Option<String>,
        single: bool,
    ) -> PyResult<String> {
        let source = emit::Emittable::Model(Box::new((*self.model).clone()));
        let (name, language) = (self.name.clone(), language.to_owned());
        let made =
            work(py, None, move |_| emitted(&name, source, &language, prefix, None, single))?;
        made.map_err(|error| raised(py, &error))
    }
}
