//! Wrong input of `stickslip gmsh`: one line that names what is wrong.

use std::fs;

use crate::{Outcome, folder, program};

/// Two squares of two triangles each, without names: group 7 is the face between them, group 8 on the boundary.
const STRIP: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n\
                     6 2 1 0\n$EndNodes\n$Elements\n6\n1 1 2 7 1 2 5\n2 1 2 8 2 1 4\n3 2 2 1 1 1 2 5\n\
                     4 2 2 1 1 1 5 4\n5 2 2 1 1 2 3 6\n6 2 2 1 1 2 6 5\n$EndElements\n";

#[test]
fn wrong_input_of_a_mesh_is_one_line() -> Outcome {
    let folder = folder("refusals")?;
    let file = folder.join("strip.msh");
    fs::write(&file, STRIP)?;
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
        let mut command = program("gmsh");
        command.arg(&file).args(arguments).arg("--out").arg(&folder);
        if under_compression {
            command.args(compressed);
        }
        let output = command.output()?;
        let error = String::from_utf8(output.stderr)?;
        assert!(!output.status.success(), "accepted: {arguments:?}");
        assert_eq!(error.lines().count(), 1, "{arguments:?}: {error}");
        assert!(error.contains(expected), "{arguments:?}: {error}");
    }
    Ok(())
}
