//! Errors in a file, with their places and numbers.

use stickslip_fem::{FemError, FileItem, FilePlace, ReadError, gmsh};

/// Two triangles of a unit square; the bottom is group 1, "fault", the cells are group 2, "rock".
const TWO: &str = "$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 \"fault\"
2 2 \"rock\"
$EndPhysicalNames
$Nodes
4
11 0 0 0
12 1 0 0
13 1 1 0
14 0 1 0
$EndNodes
$Elements
3
21 1 2 1 1 11 12
22 2 2 2 1 11 12 13
23 2 2 2 1 11 13 14
$EndElements
";

/// The same in version 4.1.
const FOUR: &str = "$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 \"fault\"
2 2 \"rock\"
$EndPhysicalNames
$Entities
0 1 1 0
5 0 0 0 1 0 0 1 1 0
6 0 0 0 1 1 0 1 2 1 5
$EndEntities
$Nodes
2 4 11 14
1 5 0 2
11
12
0 0 0
1 0 0
2 6 0 2
13
14
1 1 0
0 1 0
$EndNodes
$Elements
2 3 21 23
1 5 1 1
21 11 12
2 6 2 2
22 11 12 13
23 11 13 14
$EndElements
";

fn error(text: &str) -> ReadError {
    gmsh::parse::<2>(text.as_bytes()).unwrap_err()
}

/// The error after one change of the text, and how it reads.
fn changed(text: &str, from: &str, to: &str) -> (ReadError, String) {
    assert_eq!(text.matches(from).count(), 1, "{from}");
    let error = error(&text.replace(from, to));
    let message = error.to_string();
    (error, message)
}

#[track_caller]
fn reads(text: &str, from: &str, to: &str, expected: &str) {
    assert_eq!(changed(text, from, to).1, expected);
}

#[test]
fn the_good_files_are_good() {
    let [two, four] = [TWO, FOUR].map(|text| gmsh::parse::<2>(text.as_bytes()).unwrap());
    assert_eq!(two, four);
    assert_eq!((two.vertex_count(), two.cell_count()), (4, 2));
}

#[test]
fn what_is_no_file_of_gmsh_is_refused() {
    for text in [
        "",
        "\u{0}\u{1}",
        "solid cube\n",
        "$Nodes\n1\n",
        "MeshFormat",
    ] {
        let error = error(text);
        assert!(
            matches!(&error, ReadError::Unexpected { expected, .. } if expected.contains("$MeshFormat")),
            "{error}"
        );
    }
    assert!(matches!(
        changed(TWO, "2.2 0", "4 0").0,
        ReadError::Format {
            what: "version of the format",
            value: 4.0,
            ..
        }
    ));
    assert!(matches!(
        changed(TWO, "0 8", "0 4").0,
        ReadError::Format {
            what: "size of numbers [byte]",
            value: 4.0,
            ..
        }
    ));
    assert!(matches!(
        changed(TWO, "0 8\n$", "1 8\nabcd$").0,
        ReadError::Unexpected { expected, found: Some(found), .. } if expected.contains("order of bytes") && found == "abcd"
    ));
    let line = FilePlace::Line(1);
    assert!(
        matches!(error("$MeshFormat"), ReadError::Unexpected { found: None, at, .. } if at == line)
    );
}

#[test]
fn sections_are_as_long_as_they_say() {
    reads(
        TWO,
        "\n4\n11",
        "\n3\n11",
        "line 14: found \"14\" in place of $EndNodes",
    );
    reads(
        TWO,
        "\n4\n11",
        "\n5\n11",
        "line 15: found \"$EndNodes\" in place of the number of a node",
    );
    reads(
        TWO,
        "\n4\n11",
        "\n\n11",
        "line 11: found \"0\" in place of the end of a line",
    );
    reads(
        TWO,
        "$EndNodes\n",
        "",
        "line 15: found \"$Elements\" in place of $EndNodes",
    );
    reads(
        TWO,
        "13 14\n$EndElements\n",
        "13",
        "line 20: the file ends where the number of a node was expected",
    );
    reads(
        TWO,
        "\n$EndElements\n",
        "\n",
        "line 21: the file ends where the end of a section was expected",
    );
    reads(
        TWO,
        "1 1 0\n",
        "1 x 0\n",
        "line 13: found \"x\" in place of a coordinate",
    );
    reads(
        FOUR,
        "2 4 11 14",
        "2 5 11 14",
        "$Nodes at line 15 declares 5 items and holds 4",
    );
    reads(
        FOUR,
        "2 3 21 23",
        "2 2 21 23",
        "$Elements at line 28 declares 2 items and holds 3",
    );
    reads(
        FOUR,
        "1 5 0 2",
        "4 5 0 2",
        "line 16: found \"4\" in place of a dimension from 0 to 3",
    );
    reads(
        FOUR,
        "1 5 0 2",
        "1 5 2 2",
        "line 16: found \"2\" in place of 0 or 1 for parameters",
    );
    reads(
        TWO,
        "1 1 \"fault\"",
        "1 1 fault",
        "line 6: found \" fault\" in place of a name between quotation marks",
    );

    for dimension in ["4", "18446744073709551615"] {
        let found = format!("line 6: found \"{dimension}\" in place of a dimension from 0 to 3");
        reads(
            TWO,
            "1 1 \"fault\"",
            &format!("{dimension} 1 \"fault\""),
            &found,
        );
    }

    assert!(matches!(
        changed(TWO, "$Elements\n", "$Others\n").0,
        ReadError::Unexpected { expected, found: None, .. } if expected == "the end of a section"
    ));
    let without = TWO.split("$Elements").next().unwrap();
    assert!(matches!(
        error(without),
        ReadError::Empty { what: "section", name, .. } if name == "Elements"
    ));
    let names = "$PhysicalNames\n0\n$EndPhysicalNames\n";
    assert!(matches!(
        error(&format!("{TWO}{names}")),
        ReadError::Unexpected { expected, found: Some(found), at: FilePlace::Line(22) } if expected == "no second $PhysicalNames" && found == "$PhysicalNames"
    ));
}

#[test]
fn other_elements_say_what_to_export() {
    let quadrangle = "line 19: element 22 is a quadrangle (kind 3): export triangles or tetrahedra: \
                      no \"Recombine\", Mesh.RecombineAll = 0, no layers of recombined extrusions";
    reads(
        TWO,
        "22 2 2 2 1 11 12 13",
        "22 3 2 2 1 11 12 13 14",
        quadrangle,
    );
    let second = "line 31: element 22 is a triangle of higher order (kind 9): \
                  save elements of first order: Mesh.ElementOrder = 1";
    // The heading of the elements has line 31.
    reads(FOUR, "2 6 2 2\n", "2 6 9 2\n", second);
    assert!(matches!(
        changed(TWO, "22 2 2", "22 92 2").0,
        ReadError::Kind { number: 92, .. }
    ));
    assert!(matches!(
        gmsh::parse::<3>(TWO.as_bytes()),
        Err(ReadError::Empty {
            what: "elements",
            dimension: Some(3),
            ..
        })
    ));
    reads(
        TWO,
        "22 2 2 2 1 11 12 13",
        "22 4 2 2 1 11 12 13 14",
        "line 19: element 22 is a tetrahedron, which a mesh of 2 dimensions does not have",
    );
    reads(
        FOUR,
        "2 6 2 2\n",
        "1 5 2 2\n",
        "line 31: element 22 is a triangle, which an entity of 1 dimensions does not have",
    );
}

#[test]
fn nodes_are_those_of_elements() {
    for (text, line) in [(TWO, 14), (FOUR, 23)] {
        let (from, to) = if text == TWO {
            ("14 0 1 0", "12 0 1 0")
        } else {
            ("\n14\n1", "\n12\n1")
        };
        assert!(matches!(
            changed(text, from, to).0,
            ReadError::Repeated { item: FileItem { what: "node", number: 12, dimension: None }, at: FilePlace::Line(at) } if at == line
        ));
    }
    assert!(matches!(
        changed(TWO, "11 13 14", "11 13 15").0,
        ReadError::Unknown {
            item: FileItem {
                what: "node",
                number: 15,
                dimension: None
            },
            element: 23,
            at: FilePlace::Line(20)
        }
    ));
    let more = TWO.replace("\n4\n11", "\n5\n15 3 3 0\n11");
    assert!(matches!(
        error(&more),
        ReadError::Node {
            node: 15,
            requirement: "an element",
            at: FilePlace::Line(11)
        }
    ));
    assert!(matches!(
        changed(TWO, "13 1 1 0", "13 1 inf 0").0,
        ReadError::Node {
            node: 13,
            requirement: "finite coordinates",
            at: FilePlace::Line(13)
        }
    ));
    assert!(matches!(
        changed(TWO, "13 1 1 0", "13 1 1 0.5").0,
        ReadError::NotPlane {
            node: 13,
            z: 0.5,
            first: 0.0,
            at: FilePlace::Line(13)
        }
    ));
}

#[test]
fn bad_cells_are_refused_by_their_numbers() {
    assert!(matches!(
        changed(TWO, "14 0 1 0", "14 0.5 0.5 0").0,
        ReadError::Flat {
            element: 23,
            volume: 0.0,
            at: FilePlace::Line(20)
        }
    ));
    assert!(matches!(
        changed(FOUR, "23 11 13 14", "23 11 13 13").0,
        // Node 14 is noticed first.
        ReadError::Node {
            node: 14,
            requirement: "an element",
            at: FilePlace::Line(23)
        }
    ));
    let twice = TWO
        .replace("\n3\n21", "\n4\n21")
        .replace("$EndElements", "24 2 2 2 1 12 13 11\n$EndElements");
    assert!(matches!(
        error(&twice),
        ReadError::Same {
            what: "elements",
            numbers: [22, 24],
            share: "nodes",
            at: FilePlace::Line(21)
        }
    ));
    let (overlap, _) = changed(TWO, "14 0 1 0", "14 1 0.5 0");
    assert!(matches!(
        overlap,
        ReadError::Overlap { elements, nodes, at: FilePlace::Line(20) } if elements == [22, 23] && nodes == [11, 13]
    ));
}

#[test]
fn parts_are_faces() {
    reads(
        FOUR,
        "21 11 12\n",
        "21 12 14\n",
        "line 30: element 21 of the group \"fault\" is no face of the mesh: 0 cells have its nodes",
    );
    let twice = TWO
        .replace("\n3\n21", "\n4\n21")
        .replace("$EndElements", "24 1 2 1 1 12 11\n$EndElements");
    assert!(matches!(
        error(&twice),
        ReadError::Same {
            what: "elements",
            numbers: [21, 24],
            share: "nodes",
            at: FilePlace::Line(21)
        }
    ));
}

#[test]
fn parts_are_surfaces() {
    // Two triangles that meet at node 13, and all of their sides there.
    let text = TWO
        .replace("14 0 1 0", "14 1 2 0\n15 2 1 0")
        .replace("\n4\n11", "\n5\n11")
        .replace("23 2 2 2 1 11 13 14", "23 2 2 2 1 13 15 14")
        .replace(
            "\n3\n21 1 2 1 1 11 12",
            "\n6\n21 1 2 1 1 12 13\n24 1 2 1 1 13 11\n25 1 2 1 1 13 15\n26 1 2 1 1 14 13",
        );
    let found = error(&text);
    assert!(matches!(
        &found,
        ReadError::NotManifold { group, elements, nodes, at: FilePlace::Line(22) }
            if group == "fault" && *elements == [21, 24, 25, 26] && *nodes == [13]
    ));
    assert_eq!(
        found.to_string(),
        "line 22: 4 elements of the group \"fault\" meet at the nodes [13]: [21, 24, 25, 26]"
    );
}

#[test]
fn groups_have_one_name_and_elements() {
    let (missing, _) = changed(TWO, "21 1 2 1 1", "21 1 2 0 1");
    assert!(
        matches!(missing, ReadError::Empty { what: "elements in the group", name, dimension: Some(1), .. } if name == "fault")
    );
    let (missing, _) = changed(FOUR, "6 0 0 0 1 1 0 1 2 1 5", "6 0 0 0 1 1 0 0 1 5");
    assert!(
        matches!(missing, ReadError::Empty { what: "elements in the group", name, dimension: Some(2), .. } if name == "rock")
    );
    assert!(matches!(
        changed(FOUR, "2 6 2 2", "2 7 2 2").0,
        ReadError::Unknown {
            item: FileItem {
                what: "entity",
                number: 7,
                dimension: Some(2)
            },
            element: 22,
            at: FilePlace::Line(31)
        }
    ));
    let again = FOUR.replace("0 1 1 0\n5 0", "0 2 1 0\n5 0 0 0 1 0 0 0 0\n5 0");
    assert!(matches!(
        error(&again),
        ReadError::Repeated {
            item: FileItem {
                what: "entity",
                number: 5,
                dimension: Some(1)
            },
            at: FilePlace::Line(12)
        }
    ));
    assert!(matches!(
        changed(FOUR, "1 1 0 1 2 1 5", "1 1 0 65 2 1 5").0,
        ReadError::TooManyGroups {
            entity: FileItem {
                what: "entity",
                number: 6,
                dimension: Some(2)
            },
            groups: 65,
            at: FilePlace::Line(12)
        }
    ));
    assert!(matches!(
        changed(TWO, "2 2 \"rock\"", "1 1 \"rock\"").0,
        ReadError::Repeated {
            item: FileItem {
                what: "name of group",
                number: 1,
                dimension: Some(1)
            },
            at: FilePlace::Line(7)
        }
    ));
    // Group 3 has no name, and group 1 is called so.
    let called = TWO
        .replace("fault", "3")
        .replace("\n3\n21", "\n4\n24 1 2 3 1 12 13\n21");
    assert!(matches!(
        error(&called),
        ReadError::Fem(FemError::RepeatedName { name }) if name == "3"
    ));
}

#[test]
fn groups_of_points_and_of_higher_dimension_are_passed_over() {
    let named = TWO.replace("\n2\n1 1", "\n4\n0 8 \"corner\"\n3 9 \"air\"\n1 1");
    let named = named.replace("\n3\n21", "\n4\n20 15 2 8 1 11\n21");
    let mesh = gmsh::parse::<2>(named.as_bytes()).unwrap();
    assert_eq!(mesh, gmsh::parse::<2>(TWO.as_bytes()).unwrap());
}

#[test]
fn what_is_not_read_is_named() {
    let one = error("$NOD\n1\n1 0 0 0\n$ENDNOD\n$ELM\n1\n1 2 1 1 3 1 1 1\n$ENDELM\n");
    assert_eq!(
        one.to_string(),
        "version of the format 1 is not read: save as version 4.1 or 2.2, Mesh.MshFileVersion = 4.1"
    );
    let partitioned = changed(
        FOUR,
        "$Nodes\n",
        "$PartitionedEntities\n2\n0\n0 0 0 0\n$EndPartitionedEntities\n$Nodes\n",
    );
    let ReadError::Section { section, at, .. } = partitioned.0 else {
        panic!("{}", partitioned.1);
    };
    assert_eq!((section, at), ("PartitionedEntities", FilePlace::Line(14)));
}

/// A plane mesh is no solid, and lines are no plane mesh.
#[test]
fn elements_of_fewer_dimensions_are_named() {
    for text in [TWO, FOUR] {
        let error = gmsh::parse::<3>(text.as_bytes()).unwrap_err().to_string();
        let begin = "no elements of dimension 3: the file has surfaces only, of triangles";
        assert!(error.starts_with(begin), "{error}");
    }
    let lines = TWO.replace(
        "22 2 2 2 1 11 12 13\n23 2 2 2 1 11 13 14",
        "22 1 2 1 1 12 13\n23 1 2 1 1 13 14",
    );
    let error = error(&lines).to_string();
    let begin = "no elements of dimension 2: the file has lines only";
    assert!(error.starts_with(begin), "{error}");
}
