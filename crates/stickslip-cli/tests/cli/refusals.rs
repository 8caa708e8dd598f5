//! Wrong input: one line that names what is wrong, before anything runs, of every command within this process.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use stickslip_cli::commands;

use crate::{Outcome, folder};

/// The one line by which a command refuses these words, to which a folder for its files is added.
fn refusal<'a>(words: impl IntoIterator<Item = &'a str>, folder: &Path) -> Outcome<String> {
    let words: Vec<_> = words.into_iter().map(OsString::from).collect();
    // Of two folders the last counts: that of the words, if they have one.
    let after = usize::from(!words.is_empty());
    let (command, arguments) = words.split_at(after);
    let out = [OsString::from("--out"), folder.into()];
    let line = command.iter().chain(&out).chain(arguments).cloned();
    let Err(refusal) = commands::answer(line) else {
        return Err(format!("accepted: {words:?}").into());
    };
    let message = refusal.message;
    assert_eq!(message.lines().count(), 1, "{words:?}: {message}");
    assert!(refusal.status > 0, "{words:?}: {message}");
    Ok(message)
}

/// Two squares of two triangles each, without names: group 7 is the face between them, group 8 on the boundary.
const STRIP: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n\
                     6 2 1 0\n$EndNodes\n$Elements\n6\n1 1 2 7 1 2 5\n2 1 2 8 2 1 4\n3 2 2 1 1 1 2 5\n\
                     4 2 2 1 1 1 5 4\n5 2 2 1 1 2 3 6\n6 2 2 1 1 2 6 5\n$EndElements\n";

#[test]
fn wrong_input_of_a_mesh_is_one_line() -> Outcome {
    let folder = folder("refusals")?;
    let file = folder.join("strip.msh");
    fs::write(&file, STRIP)?;
    let file = file.to_str().ok_or("the folder has no name in Unicode")?;
    let compressed = ["--compression", "1", "--direction", "1,0"];
    let cases: [(&[&str], bool, &str); 14] = [
        (
            &["--contact", "9"],
            true,
            "inside the body are [\"7\"], on its boundary [\"8\"]",
        ),
        (&["--contact", "7", "--driven", "9"], false, "\"9\""),
        (
            &["--contact", "7", "--driven", "8", "--opposite", "8"],
            false,
            "--opposite",
        ),
        (&["--contact", "7", "--opposite", "8"], false, "--driven"),
        (&["--contact", "7", "--driven", "8"], true, "--compression"),
        (&["--contact", "7", "--opposite", "8"], true, "--opposite"),
        (&["--contact", "7", "--fixed", "8"], true, "--fixed"),
        (&["--contact", "8"], true, "is on the boundary"),
        (&["--contact", "7", "--steps", "0"], true, "at least 1"),
        (&["--contact", "7", "--steps", "1e3"], true, "at least 1"),
        (&["--contact", "7", "--contact", "7"], true, "twice"),
        (
            &["--contact", "7", "--compression", "1"],
            false,
            "--direction",
        ),
        (
            &["--contact", "7", "--normal-stress", "body:1"],
            true,
            "body+PASCAL",
        ),
        (
            &[
                "--contact",
                "7",
                "--law",
                "none",
                "--friction",
                "regularized",
            ],
            true,
            "needs a state",
        ),
    ];
    for (arguments, under_compression, expected) in cases {
        let words = [&["gmsh", file][..], arguments];
        let compression = if under_compression {
            &compressed[..]
        } else {
            &[]
        };
        let words = words.into_iter().chain([compression]).flatten().copied();
        let error = refusal(words, &folder)?;
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
    Ok(())
}

/// A command, with arguments that it refuses one by one.
type Wrong<'a> = (&'a str, &'a [&'a str]);

const WRONG: [Wrong<'_>; 9] = [
    (
        "slider --until 0.001",
        &[
            "--steps 0",
            "--no-such-flag",
            "--young-modulus=-1",
            "--density nan",
            "--a 0",
            "--frequency 0",
            "--body reduced --refinements 1 --frequency 1",
            "--out /dev/null/x",
        ],
    ),
    (
        "spring-slider",
        &[
            "--dt 0",
            "--no-such-flag",
            "--stiffness=-1",
            "--hold 3,2",
            "no-such-preset",
            "--a nan",
            "--out /dev/null/x",
        ],
    ),
    (
        "fit ../../examples/data/steps-and-holds.csv --displacement-unit 1e-6",
        &[
            "--columns x",
            "--steps 0",
            "--steps 0:1e-6 --columns time,friction",
            "--window 5:1",
            "--law foo",
            "--fix q=1",
            "--stiffness=-1",
            "--states 3",
            "--out /dev/null/x",
        ],
    ),
    ("fit none.csv", &[""]),
    (
        "figures",
        &[
            "",
            "6.6",
            "1.1 --no-such-flag",
            "1.1 --threads 0",
            "1.1 --out /dev/null/x",
        ],
    ),
    (
        "gmsh --until 0.001",
        &[
            "--mesh none.msh",
            "--mesh README.md",
            "--contact nowhere",
            "--driven fault",
            "--direction 0,1",
            "--probe 1",
            "--compression 1",
            "--compression 1 --direction 1,0",
            "--opposite top",
            "--normal-stress vacuum",
            "--fixed nowhere",
        ],
    ),
    (
        "sweep",
        &[
            "--sets 0",
            "--steps 0",
            "--threads 0",
            "--frequency nan",
            "--frequency 1",
            "--refinements 11",
            "--out /dev/null/x",
        ],
    ),
    (
        "earthquakes --years 1",
        &[
            "--cell 0",
            "--cell 300",
            "--years nan",
            "--problem bp9",
            "--adaptive=-1",
            "--method euler",
            "--dip 60",
            "--problem bp3 --dip 95",
            "--problem bp3 --thrust --normal",
            "--problem bp5 --method implicit",
            "--problem bp7 --components 3",
            "--problem bp6 --source well",
            "--seas /dev/null/x",
            "--out /dev/null/x",
        ],
    ),
    ("no-such-command", &[""]),
];

#[test]
fn wrong_input_of_a_command_is_one_line() -> Outcome {
    let folder = folder("wrong")?;
    for (command, all) in WRONG {
        for arguments in all {
            let words = command.split_whitespace();
            refusal(words.chain(arguments.split_whitespace()), &folder)?;
        }
    }
    refusal(["slider3d", "--refinements", "6"], &folder)?;
    refusal(["rupture", "--cell", "0"], &folder)?;
    Ok(())
}

/// A checkpoint that is none, damaged or of another run. One of a run that has ended continues it, by nothing.
#[test]
fn checkpoints_of_other_runs_are_refused() -> Outcome {
    let folder = folder("other_runs")?;
    let path = |name: &str| folder.join(name).into_os_string();
    let kept = path("checkpoint");
    let run = "slider --refinements 1 --until 0.01 --checkpoint-every 30";
    let run = |more: &[OsString]| {
        let words = run.split_whitespace().map(OsString::from);
        let files = [
            "--checkpoint".into(),
            kept.clone(),
            "--out".into(),
            path("kept"),
        ];
        commands::answer(words.chain(files).chain(more.iter().cloned()))
    };
    run(&[]).map_err(|refusal| refusal.message)?;
    let history = fs::read(folder.join("kept/history.csv"))?;
    let whole = fs::read(&kept)?;
    fs::write(path("cut"), &whole[..1000])?;
    fs::write(
        path("changed"),
        [&whole[..1000], b"changed", &whole[1007..]].concat(),
    )?;
    fs::write(path("text"), "step,time\n")?;
    fs::write(path("empty"), "")?;
    let restart = |name: &str| vec!["--restart".into(), path(name)];
    let mut cases: Vec<Vec<OsString>> = ["none", "cut", "changed", "text", "empty", ""]
        .map(restart)
        .into();
    for other in [
        "--density 6e3",
        "--refinements 2",
        "--scheme backward-euler",
        "--solver condensed",
        "--law ruina",
        "--steps 20000",
        "--a 0.011",
        "--until 0.001",
    ] {
        let other = other.split_whitespace().map(OsString::from);
        cases.push(restart("checkpoint").into_iter().chain(other).collect());
    }
    cases.push(vec!["--checkpoint-every".into(), "0".into()]);
    cases.push(vec!["--checkpoint".into(), "/dev/null/x".into()]);
    for more in cases {
        let Err(refusal) = run(&more) else {
            return Err(format!("accepted: {more:?}").into());
        };
        assert_eq!(
            refusal.message.lines().count(),
            1,
            "{more:?}: {}",
            refusal.message
        );
    }
    let alone = ["slider", "--checkpoint-every", "5", "--until", "0.01"];
    refusal(alone, &folder)?;
    run(&restart("checkpoint")).map_err(|refusal| refusal.message)?;
    assert!(fs::read(folder.join("kept/history.csv"))? == history);
    Ok(())
}
