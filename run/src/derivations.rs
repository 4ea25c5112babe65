//! Systems derived from one text, and what their series say of errors, kept for later calls.

use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::problem::{Parameter, Problem, Symbol};
use coadjoint_codegen::tolerance::{Prospects, Target, ToleranceError};

use crate::ensemble::in_lanes;
use crate::error::RunError;
use crate::load::{Derived, System};

/// Systems that are kept, and prospects: of several starts and durations, in both frames.
const MOST: usize = 64;

/// The systems derived from one text, with several values of its parameters, and the prospects of its truncations.
#[derive(Debug, Default)]
pub struct Derivations {
    systems: Mutex<Vec<(Purpose, Arc<Derived>)>>,
    prospects: Mutex<Vec<(Question, Arc<Prospects>)>>,
}

/// The truncation, the frame of a series or collocation, the parameters that are kept, whether trajectories go side by side, and the
/// parameters whose values are put in.
type Purpose = (usize, &'static str, Vec<String>, bool, Vec<Parameter>);

/// The frame, the Hamiltonian with its symbols, the parameters that are kept with their values, a target whose tolerance is left out, and
/// the products of coefficients allowed.
type Question = (&'static str, (Polynomial, Vec<Symbol>, Vec<Parameter>), Target, u64);

/// The value of a key in a list.
fn known<K: PartialEq, V: Clone>(list: &[(K, V)], key: &K) -> Option<V> {
    list.iter().find(|(other, _)| other == key).map(|(_, value)| value.clone())
}

/// Adds an entry to a list, which loses its first one where it is full.
fn keep<E>(list: &mut Vec<E>, entry: E) {
    if list.len() == MOST {
        list.remove(0);
    }
    list.push(entry);
}

/// The list behind a lock: a thread that panicked has added whole entries, if any.
fn locked<T>(list: &Mutex<T>) -> MutexGuard<'_, T> {
    list.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Derivations {
    /// The system of the text as it was read now, with its method: kept, or derived for runs or for ensembles.
    ///
    /// # Errors
    /// As [`Derived::of_file`], and for ensembles as [`in_lanes`].
    pub fn derive(
        &self,
        file: &Path,
        system: System,
        ensemble: bool,
    ) -> Result<Arc<Derived>, RunError> {
        let frame = system.problem.polynomial().map_or("collocation", Problem::frame_name);
        let facts = system.problem.facts();
        let kept: Vec<_> = facts.parameters.iter().map(|own| own.name.clone()).collect();
        let put_in = system.parameters.iter().filter(|own| !kept.contains(&own.name)).cloned();
        let put_in = put_in.collect();
        let purpose = (facts.truncation, frame, kept, ensemble, put_in);
        let values = facts.defaults();
        let at = |found: Arc<Derived>| match found.values == values {
            true => found,
            false => Arc::new(found.at(&values)),
        };
        let found = known(&locked(&self.systems), &purpose);
        if let Some(found) = found {
            return Ok(at(found));
        }
        let system = if ensemble { in_lanes(system)? } else { system };
        let made = Arc::new(Derived::of_file(file, system)?);
        let mut systems = locked(&self.systems);
        // Another thread may have been quicker.
        Ok(at(known(&systems, &purpose).unwrap_or_else(|| {
            keep(&mut systems, (purpose, made.clone()));
            made
        })))
    }

    /// The prospects of a problem for any tolerance of this target.
    pub(crate) fn prospects(
        &self,
        problem: &Problem,
        target: &Target,
        limit: TermLimit,
    ) -> Result<Arc<Prospects>, ToleranceError> {
        let any = Target { tolerance: 0.0, ..target.clone() };
        let Problem { hamiltonian, symbols, parameters, .. } = problem;
        let asked = (hamiltonian.clone(), symbols.clone(), parameters.clone());
        let question = (problem.frame_name(), asked, any, limit.products);
        if let Some(found) = known(&locked(&self.prospects), &question) {
            return Ok(found);
        }
        let made = Arc::new(Prospects::new(&problem.with_defaults(), target, limit)?);
        keep(&mut locked(&self.prospects), (question, made.clone()));
        Ok(made)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Accuracy, meet_tolerance, read_varying};

    #[test]
    fn later_tolerances_use_what_earlier_ones_derived() {
        let text = "group = \"SO3\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5\"\n\
                    [integrator]\nframe = \"fixed\"\n[initial]\nmomentum = [2, 0.5, 1]\n[run]\ntime = 10\n";
        let kept = Derivations::default();
        let meet = |tolerance, kept: &Derivations| {
            let mut system = read_varying("body", text, Default::default(), &[]).unwrap();
            let asked = Accuracy { tolerance: Some(tolerance), ..Accuracy::default() };
            meet_tolerance(Path::new("body"), &mut system, &asked, kept).unwrap().unwrap()
        };
        let (choice, derived) = meet(1e-3, &kept);
        let followed = locked(&kept.prospects).len();
        let (other, finer) = meet(1e-12, &kept);
        assert!(other.truncation > choice.truncation && other.error <= 1e-12, "{other}");
        assert!(!Arc::ptr_eq(&derived, &finer));
        assert_eq!(locked(&kept.prospects).len(), followed, "errors were followed anew");
        // The choice does not depend on what was asked before.
        assert_eq!(meet(1e-12, &Derivations::default()).0, other);
        let (again, known) = meet(1e-3, &kept);
        assert_eq!(again, choice);
        assert!(Arc::ptr_eq(&derived, &known));
    }
}
