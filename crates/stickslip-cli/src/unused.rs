//! Arguments that a command would not use, given the others: refused by their names.

use clap::ArgMatches;
use clap::parser::ValueSource;

/// An argument of commands, when it is not used, and what it is for.
struct Rule {
    commands: &'static [&'static str],
    argument: &'static str,
    unused: fn(&Given<'_>) -> bool,
    is_for: &'static str,
}

/// What a command line gives.
struct Given<'a>(&'a ArgMatches);

impl Given<'_> {
    /// The value of an argument, given or by default.
    fn is(&self, argument: &str, values: &[&str]) -> bool {
        let found = self.0.try_get_raw(argument).ok().flatten();
        let mut found = found.into_iter().flatten();
        found
            .next()
            .is_some_and(|value| values.iter().any(|other| *other == value))
    }

    /// Whether the command line itself has an argument.
    fn has(&self, argument: &str) -> bool {
        let known = self.0.try_contains_id(argument).unwrap_or(false);
        known && self.0.value_source(argument) == Some(ValueSource::CommandLine)
    }

    /// Whether friction has no state: a constant coefficient.
    fn is_stateless(&self) -> bool {
        let constant = self.is("friction", &["tresca", "coulomb"]);
        self.is("law", &["none"]) || constant && !self.has("law")
    }
}

const WITH_LAWS: &[&str] = &["slider", "spring-slider", "gmsh"];
const A_STATE: &str = "friction with a state: another --law or --friction";
const INERTIA: &str = "a body that is driven, without --compression";

const RULES: [Rule; 19] = [
    of_a_state("b"),
    of_a_state("slip_distance"),
    of_a_state("reference_velocity"),
    of_a_state("initial_log_theta"),
    of_a_state("initial_theta"),
    Rule {
        commands: WITH_LAWS,
        argument: "a",
        unused: |given| given.is_stateless() || given.is("friction", &["tresca", "coulomb"]),
        is_for: "friction by rate and state: another --friction",
    },
    Rule {
        commands: &["slider"],
        argument: "frequency",
        unused: |given| !given.is("body", &["reduced"]),
        is_for: "--body reduced",
    },
    Rule {
        commands: &["slider"],
        argument: "spectral_radius",
        unused: |given| !given.is("scheme", &["generalized-alpha", "generalised-alpha"]),
        is_for: "--scheme generalized-alpha",
    },
    Rule {
        commands: &["slider"],
        argument: "solver",
        unused: |given| {
            given.is("scheme", &["central-differences"]) || given.is("body", &["reduced"])
        },
        is_for: "implicit schemes of --body full",
    },
    Rule {
        commands: &["slider"],
        argument: "max_steps",
        unused: |given| !given.has("adaptive"),
        is_for: "steps that adapt: add --adaptive",
    },
    Rule {
        commands: &["slider"],
        argument: "checkpoint_every",
        unused: |given| !given.has("checkpoint"),
        is_for: "a run that is kept: add --checkpoint",
    },
    Rule {
        commands: &["gmsh"],
        argument: "opposite",
        unused: |given| !given.has("driven"),
        is_for: "the opposite of a driven part: add --driven",
    },
    Rule {
        commands: &["rupture"],
        argument: "scheme",
        unused: |given| {
            let weakens = given.is("problem", &["tpv5", "tpv6", "tpv205"]);
            weakens && given.is("scheme", &["implicit"])
        },
        is_for: "friction of rate and state if implicit: --problem tpv101, tpv103 or tpv105",
    },
    of_two_sides("relaxation_distance"),
    of_two_sides("relaxation_velocity"),
    of_measured("resolution"),
    of_measured("initial_velocity"),
    of_inertia("density"),
    of_inertia("no_gravity"),
];

const fn of_a_state(argument: &'static str) -> Rule {
    Rule {
        commands: WITH_LAWS,
        argument,
        unused: |given| given.is_stateless(),
        is_for: A_STATE,
    }
}

const fn of_measured(argument: &'static str) -> Rule {
    Rule {
        commands: &["fit"],
        argument,
        unused: |given| given.has("steps") || given.has("steps_at"),
        is_for: "a measured displacement, without --steps and --steps-at",
    }
}

const fn of_two_sides(argument: &'static str) -> Rule {
    Rule {
        commands: &["rupture"],
        argument,
        unused: |given| !given.is("problem", &["tpv6"]),
        is_for: "a normal stress between two materials: --problem tpv6",
    }
}

const fn of_inertia(argument: &'static str) -> Rule {
    Rule {
        commands: &["gmsh"],
        argument,
        unused: |given| given.has("compression"),
        is_for: INERTIA,
    }
}

/// Refuses arguments that the command does not use with the others.
///
/// # Errors
/// In one line: the name of the first of them, and what it is for.
pub(crate) fn check(matches: &ArgMatches) -> Result<(), String> {
    let Some((command, matches)) = matches.subcommand() else {
        return Ok(());
    };
    let given = Given(matches);
    let of_command = RULES.iter().filter(|rule| rule.commands.contains(&command));
    for rule in of_command {
        if given.has(rule.argument) && (rule.unused)(&given) {
            let name = rule.argument.replace('_', "-");
            return Err(format!(
                "--{name} is not used here; it is for {}",
                rule.is_for
            ));
        }
    }
    Ok(())
}
