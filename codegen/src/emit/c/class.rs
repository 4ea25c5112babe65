//! The class of C++.

use super::names::Names;
use super::programs::casimirs;
use crate::integrator::Integrator;
use crate::step::Step;

/// The class, for compilers of C++ alone.
pub(crate) fn class(integrator: &Integrator, step: &Step, names: &Names) -> String {
    let with = !integrator.problem.parameters.is_empty();
    let text = CLASS
        .replace("/*PARAMETERS*/", if with { PARAMETERS } else { "" })
        .replace("/*ARGUMENT*/", if with { ", const Parameters &parameters" } else { "" })
        .replace("/*PASSED*/", if with { ", &parameters" } else { "" })
        .replace("/*CASIMIRS*/", if casimirs(step) > 0 { CLASS_CASIMIRS } else { "" });
    names.fill(&format!("\n#if defined(__cplusplus){text}#endif\n"))
}

/// The name of the parameters in the class.
const PARAMETERS: &str = "    typedef @p@_parameters Parameters;\n";

/// The class of C++.
const CLASS: &str = "
/**
 * The same for C++11: a map with its functions. It allocates nothing and throws nothing.
 */
class @C@ {
public:
    typedef @p@_state State;
    typedef @p@_status Status;
/*PARAMETERS*/
    /** As @p@_init; ask status() whether that went well. */
    explicit @C@(double h/*ARGUMENT*/) noexcept
    {
        (void)@p@_init(&map_, h/*PASSED*/);
    }

    /** Whether steps can be made, or why not. */
    Status status() const noexcept { return map_.status; }

    /** The state at the identity with this momentum. */
    static State at_identity(const double (&mu)[@P@_DIMENSION]) noexcept
    {
        State state;
        @p@_at_identity(&state, mu);
        return state;
    }

    /** As @p@_step. */
    Status step(State &state) const noexcept { return @p@_step(&map_, &state); }

    /** As @p@_advance. */
    Status advance(State &state, uint32_t steps, uint32_t &made) const noexcept
    {
        return @p@_advance(&map_, &state, steps, &made);
    }

    /** As @p@_energy. */
    double energy(const State &state) const noexcept { return @p@_energy(&map_, &state); }
/*CASIMIRS*/
    /** As @p@_spatial_momentum. */
    static void spatial_momentum(const State &state, double (&spatial)[@P@_DIMENSION]) noexcept
    {
        @p@_spatial_momentum(&state, spatial);
    }

    /** As @p@_matrix. */
    static void matrix(const State &state, double (&entries)[@P@_ROWS * @P@_ROWS]) noexcept
    {
        @p@_matrix(&state, entries);
    }

private:
    @p@_map map_;
};
";

/// The Casimirs in the class.
const CLASS_CASIMIRS: &str = "
    /** As @p@_casimirs. */
    static void casimirs(const State &state, double (&values)[@P@_CASIMIRS]) noexcept
    {
        @p@_casimirs(&state, values);
    }
";
