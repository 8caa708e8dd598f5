//! The command line of the slider on a mesh of Gmsh.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::{Parser, ValueEnum};
use serde::Serialize;
use stickslip::NormalStress;
use stickslip::fem::{Elastic, Trace};
use stickslip::friction::DieterichRuina;
use stickslip::nalgebra::SVector;
use stickslip::problems::pipping_slider::{END, FRICTION, INITIAL_LOG_THETA, NORMAL_STRESS};

use crate::cli::{Problem, count, finite, fraction, non_negative, poisson_ratio, positive};
use crate::laws::{Friction, Law, Laws};
use crate::output::Files;

const MESH: &str = "examples/meshes/slider.msh";
const DRIVEN: &str = "top";

/// The paper's slider on a body of any shape: a mesh of Gmsh with frictional surfaces, on its boundary or inside, and a
/// driven part, or under compression
#[derive(Debug, Parser)]
pub struct Arguments {
    /// The mesh: triangles in a plane or tetrahedra, with groups of their faces by name, or by number without names
    #[arg(value_name = "FILE", conflicts_with = "mesh")]
    file: Option<PathBuf>,
    /// The mesh, as a flag
    #[arg(long, value_name = "FILE", default_value = MESH)]
    mesh: PathBuf,
    /// A frictional group: on the boundary it slides on a rigid surface, inside the mesh is split along it, and one
    /// side slides on the other. Several times for several faults, those that pass through others first
    #[arg(long, value_name = "NAME", default_value = "fault")]
    pub contact: Vec<String>,
    /// The driven group of the boundary [default: top; none with --compression]
    #[arg(long, value_name = "NAME")]
    driven: Option<String>,
    /// A group of the boundary that is driven against the driven one, by the opposite velocity
    #[arg(long, value_name = "NAME")]
    pub opposite: Option<String>,
    /// A group of the boundary that is fixed; several times for several groups
    #[arg(long, value_name = "NAME")]
    pub fixed: Vec<String>,
    /// Uniaxial compression along --direction instead of a drive [Pa]: tractions on the whole boundary, which grow
    /// linearly in the 15 s; quasi-static, without weight
    #[arg(long, value_name = "PASCAL", value_parser = positive, requires = "direction",
        conflicts_with_all = ["driven", "opposite", "fixed"])]
    pub compression: Option<f64>,
    /// The direction of the compression, or of the drive, of which the part tangential to the first contact counts: the
    /// first axis that is not normal to it by default
    #[arg(long, value_name = "X,Y[,Z]", value_delimiter = ',', value_parser = finite)]
    pub direction: Vec<f64>,
    /// The position whose nearest vertex of the first contact is recorded [m]; the middle of the contact by default
    #[arg(long, value_name = "X,Y[,Z]", value_delimiter = ',', value_parser = finite)]
    pub probe: Vec<f64>,
    /// The normal stress: prescribed [Pa], from the deformation (body), or what the deformation adds to a prescribed
    /// one (body+PASCAL) [default: 49050; body with --compression]
    #[arg(long, value_name = "body|PASCAL", value_parser = normal_stress)]
    normal_stress: Option<Stress>,
    /// Where the normal stress is a tension there is no friction, and the sides part if it is that of the body; refused
    /// otherwise
    #[arg(long)]
    pub allow_opening: bool,
    /// The friction law; tresca, or coulomb, without --law is a constant --coefficient [default: dieterich-ruina]
    #[arg(long)]
    friction: Option<Friction>,
    /// The state law [default: dieterich; none with --friction coulomb]
    #[arg(long)]
    law: Option<Law>,
    /// The coefficient of friction at the reference velocity, or the constant one
    #[arg(long, visible_alias = "coefficient", default_value_t = FRICTION.reference_friction, value_parser = non_negative)]
    reference_friction: f64,
    /// The coefficient a of the direct effect
    #[arg(long, default_value_t = FRICTION.a, value_parser = positive)]
    a: f64,
    /// The coefficient b of the evolution effect
    #[arg(long, default_value_t = FRICTION.b, value_parser = non_negative)]
    b: f64,
    /// The reference velocity [m/s]
    #[arg(long, default_value_t = FRICTION.reference_velocity, value_parser = positive)]
    reference_velocity: f64,
    /// The characteristic slip distance [m]
    #[arg(long, default_value_t = FRICTION.slip_distance, value_parser = positive)]
    slip_distance: f64,
    /// The initial value of ln(theta / 1 s)
    #[arg(long, default_value_t = INITIAL_LOG_THETA, value_parser = finite)]
    pub initial_log_theta: f64,
    /// The density [kg/m^2; kg/m^3 in space]
    #[arg(long, default_value_t = 5e3, value_parser = positive)]
    pub density: f64,
    /// Young's modulus [Pa]
    #[arg(long, default_value_t = 5e7, value_parser = positive)]
    young_modulus: f64,
    /// Poisson's ratio
    #[arg(long, default_value_t = 0.3, value_parser = poisson_ratio)]
    poisson_ratio: f64,
    /// Without the weight of the body: along the mean normal of a first contact on the boundary, down the last axis if it
    /// is inside
    #[arg(long)]
    pub no_gravity: bool,
    /// Uniform refinements of the mesh
    #[arg(long, value_name = "J", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=8))]
    pub refinements: u8,
    /// Time steps in the whole 15 s [default: 10000; 1 with --compression and no state]
    #[arg(long, value_name = "N", value_parser = count)]
    steps: Option<NonZeroUsize>,
    /// The share of the 15 s after which to stop
    #[arg(long, value_name = "FRACTION", default_value_t = 1.0, value_parser = fraction)]
    until: f64,
    /// The solver of the velocity problems
    #[arg(long, value_enum, default_value_t = Solver::Condensed)]
    pub solver: Solver,
    /// The folder and the digits of the files.
    #[command(flatten)]
    pub files: Files,
}

/// Solvers by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Solver {
    /// Factorise the body, solve on the contact
    Condensed,
    /// Truncated nonsmooth Newton multigrid
    Tnnmg,
    /// The same with the blocks of its linear problems in single precision, for large bodies in space
    TnnmgSingle,
}

/// The normal stress of the contacts on the command line \[Pa\].
#[derive(Debug, Clone, Copy, PartialEq)]
enum Stress {
    /// Prescribed.
    Prescribed(f64),
    /// From the deformation, beside a prescribed one.
    Body(f64),
}

fn normal_stress(text: &str) -> Result<Stress, String> {
    match text.strip_prefix("body") {
        None => non_negative(text)
            .map(Stress::Prescribed)
            .map_err(|wrong| format!("{wrong}, and neither body nor body+PASCAL")),
        Some("") => Ok(Stress::Body(0.0)),
        Some(beside) => match beside.strip_prefix('+') {
            Some(beside) => non_negative(beside).map(Stress::Body),
            None => Err("neither a number nor body, body+PASCAL".into()),
        },
    }
}

impl Arguments {
    /// The file of the mesh.
    pub fn mesh(&self) -> &Path {
        self.file.as_ref().unwrap_or(&self.mesh)
    }

    /// Whether this is the paper's slider on the mesh shipped.
    pub fn is_default(&self) -> bool {
        let default = Self::parse_from(["gmsh"]);
        let laws = [self.friction.is_none(), self.law.is_none()];
        let numbers = |of: &Self| {
            let elastic = [of.density, of.young_modulus, of.poisson_ratio];
            let friction = [of.reference_friction, of.a, of.b, of.initial_log_theta];
            (elastic, friction, [of.reference_velocity, of.slip_distance])
        };
        let shipped = self.mesh() == Path::new(MESH) && self.refinements == 0;
        let driven = self.compression.is_none() && self.driven() == DRIVEN;
        let alone = self.opposite.is_none() && self.fixed.is_empty() && !self.no_gravity;
        let alone = alone && !self.allow_opening;
        let setting = self.contact == default.contact && self.steps() == default.steps();
        let places = self.direction.is_empty() && self.probe.is_empty();
        let physics = numbers(self) == numbers(&default) && self.normal_stress.is_none();
        shipped && driven && alone && setting && places && physics && laws == [true, true]
    }

    /// The driven group.
    pub fn driven(&self) -> &str {
        self.driven.as_deref().unwrap_or(DRIVEN)
    }

    /// The number of steps in the whole time.
    pub fn steps(&self) -> usize {
        let stateless = self.law.is_none() && self.friction == Some(Friction::Tresca);
        let default = if stateless && self.compression.is_some() {
            1
        } else {
            10_000
        };
        self.steps.map_or(default, NonZeroUsize::get)
    }

    /// The end of the run \[s\].
    pub fn end(&self) -> f64 {
        self.until * END
    }

    /// The laws of the contacts.
    ///
    /// # Errors
    /// Friction by a state without a state law.
    pub fn laws(&self) -> Result<Laws, Problem> {
        let parameters = DieterichRuina {
            a: self.a,
            b: self.b,
            reference_friction: self.reference_friction,
            reference_velocity: self.reference_velocity,
            slip_distance: self.slip_distance,
        };
        Laws::new(self.law, self.friction, parameters)
    }

    /// The material.
    pub fn elastic(&self) -> Elastic {
        Elastic {
            young_modulus: self.young_modulus,
            poisson_ratio: self.poisson_ratio,
        }
    }

    /// The normal stress of the contacts.
    pub fn normal_stress(&self) -> NormalStress {
        let default = match self.compression {
            Some(_) => Stress::Body(0.0),
            None => Stress::Prescribed(NORMAL_STRESS),
        };
        match self.normal_stress.unwrap_or(default) {
            Stress::Prescribed(stress) => stress.into(),
            Stress::Body(beside) => NormalStress::from_body(beside),
        }
    }

    /// The unit vector of the compression.
    ///
    /// # Errors
    /// A direction of another dimension, or of length zero.
    pub fn axis<const D: usize>(&self) -> Result<SVector<f64, D>, Problem> {
        let given: SVector<f64, D> = vector("direction", &self.direction)?;
        let axis = given / given.norm();
        if axis.iter().all(|x| x.is_finite()) {
            Ok(axis)
        } else {
            Err("--direction has the length zero".into())
        }
    }

    /// The unit vector of the drive, along a contact with this mean normal. Under compression along the normal it is any
    /// tangent.
    ///
    /// # Errors
    /// A direction of another dimension, or normal to the contact.
    pub fn along<const D: usize>(
        &self,
        normal: &SVector<f64, D>,
    ) -> Result<SVector<f64, D>, Problem> {
        let unit = |axis: usize| SVector::from_fn(|c, _| f64::from(u8::from(c == axis)));
        let tangential = |x: SVector<f64, D>| x - normal * normal.dot(&x);
        let axis = || (0..D).map(unit).map(tangential).find(|x| x.norm() > 0.5);
        let given = match self.direction.len() {
            0 => axis(),
            _ => Some(tangential(vector("direction", &self.direction)?)),
        };
        let mut along = given.unwrap_or_else(SVector::zeros);
        let size = self.direction.iter().fold(0.0, |sum: f64, x| sum.hypot(*x));
        if along.norm() <= 1e-6 * size {
            match axis().filter(|_| self.compression.is_some()) {
                Some(tangent) => along = tangent,
                None => return Err("--direction is normal to the contact, or zero".into()),
            }
        }
        Ok(along.normalize())
    }

    /// The position on the contact whose nearest vertex is recorded \[m\].
    ///
    /// # Errors
    /// A position of another dimension.
    pub fn probe<const D: usize>(&self, contact: &Trace<D>) -> Result<SVector<f64, D>, Problem> {
        if self.probe.is_empty() {
            let weighted = contact.points().iter().zip(contact.weights());
            Ok(weighted.map(|(x, w)| x * *w).sum::<SVector<f64, D>>() / contact.measure())
        } else {
            vector("probe", &self.probe)
        }
    }
}

/// A vector of the mesh's dimension from the command line.
fn vector<const D: usize>(what: &str, given: &[f64]) -> Result<SVector<f64, D>, Problem> {
    let found = given.len();
    if found != D {
        let s = if found == 1 { "" } else { "s" };
        return Err(format!("--{what}: {found} number{s} for a mesh of {D} dimensions").into());
    }
    Ok(SVector::from_column_slice(given))
}
