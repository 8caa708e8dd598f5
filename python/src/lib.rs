//! The module `stickslip._stickslip` of Python.

mod arguments;
mod bodies;
mod errors;
mod exit;
mod faults;
mod fields;
mod lab;
mod laws;
mod memory;
mod own_laws;
mod plain;
mod progress;
mod raised;
mod restart;
mod run;
mod slider;
mod slider_run;
mod view;

/// Rate- and state-dependent friction.
#[pyo3::pymodule]
mod _stickslip {
    #[pymodule_export]
    use super::bodies::{Body, BodyRun, BodySimulation, BodyState, ContactState, Mesh, Part};
    #[pymodule_export]
    use super::faults::{
        FaultRun, FaultSimulation, FaultSystem, LineFault, PlaneFault, Receivers, SeasFiles,
        SeasTable, SegmentFault, Segments, SurfaceFault, Triangles,
    };
    #[pymodule_export]
    use super::fields::{
        Diffusion, Dilatancy, GaussianSource, LeakOff, PermeabilityEvolution, ShearHeating,
        ThermalPressurization, Well,
    };
    #[pymodule_export]
    use super::lab::{
        FitResult, Healing, JointFitResult, fit, healing, joint_fit, slide_hold_slide,
        velocity_step,
    };
    #[pymodule_export]
    use super::own_laws::{CompiledFriction, CompiledState};
    #[pymodule_export]
    use super::slider::SpringSlider;
    #[pymodule_export]
    use super::slider_run::SliderRun;

    #[pymodule_init]
    fn init(module: &pyo3::Bound<'_, pyo3::types::PyModule>) -> pyo3::PyResult<()> {
        use pyo3::types::PyModuleMethods;

        one_thread();
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        super::exit::register(module)
    }

    /// Keeps rayon's pool to the thread that imports the module: a child that Python forks has none of the others, and
    /// would wait for them for ever.
    fn one_thread() {
        let pool = rayon::ThreadPoolBuilder::new();
        // Another module of the process may have built the pool; it is that of another copy of rayon.
        let _ = pool.num_threads(1).use_current_thread().build_global();
    }
}
