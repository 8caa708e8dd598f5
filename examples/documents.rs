//! Scenes that show what stickslip does, in the files beside; the programs of the documents are compiled here.

#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../README.md")]
    struct Readme;

    #[doc = include_str!("../CONTRIBUTING.md")]
    struct Contributing;

    #[doc = include_str!("../docs/choosing.md")]
    struct Choosing;

    #[doc = include_str!("../docs/custom-laws.md")]
    struct CustomLaws;

    #[doc = include_str!("../docs/earthquake-cycles.md")]
    struct EarthquakeCycles;

    #[doc = include_str!("../docs/extend.md")]
    struct Extend;

    #[doc = include_str!("../docs/fault-mesh.md")]
    struct FaultMesh;

    #[doc = include_str!("../docs/fields.md")]
    struct Fields;

    #[doc = include_str!("../docs/fit-velocity-step.md")]
    struct FitVelocityStep;

    #[doc = include_str!("../docs/leave-out.md")]
    struct LeaveOut;

    #[doc = include_str!("../docs/nonplanar.md")]
    struct Nonplanar;

    #[doc = include_str!("../docs/receivers.md")]
    struct Receivers;

    #[doc = include_str!("../docs/recipes.md")]
    struct Recipes;

    #[doc = include_str!("../docs/scenes.md")]
    struct Scenes;

    #[doc = include_str!("../docs/surface-mesh.md")]
    struct SurfaceMesh;

    #[doc = include_str!("../docs/theory.md")]
    struct Theory;
}
