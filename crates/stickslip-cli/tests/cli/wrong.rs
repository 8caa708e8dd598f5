//! Wrong input of every command within this process: no panic, one line that names what is wrong in words of the command
//! line.

use std::ffi::OsString;
use std::panic::catch_unwind;
use std::path::Path;

use stickslip_cli::commands;

use crate::{Outcome, folder};

/// A command line, and what its refusal says.
type Wrong = (&'static str, &'static str);

const SLIDER: [Wrong; 22] = [
    ("slider --steps 0", "--steps"),
    ("slider --steps 1e9x", "--steps"),
    ("slider --until 1.5", "--until"),
    ("slider --refinements 99", "--refinements"),
    ("slider --law aging", "--law"),
    ("slider --friction none", "--friction"),
    ("slider --scheme euler", "--scheme"),
    ("slider --density=-5", "--density"),
    ("slider --poisson-ratio 0.5", "--poisson-ratio"),
    ("slider --frequency 100", "--frequency is not used here"),
    (
        "slider --spectral-radius 0.5",
        "--spectral-radius is not used here",
    ),
    (
        "slider --scheme central-differences --solver condensed",
        "--solver is not used here",
    ),
    (
        "slider --body reduced --solver tnnmg",
        "--solver is not used here",
    ),
    ("slider --max-steps 5", "--max-steps is not used here"),
    ("slider --adaptive 1e-3 --no-bridging", "--no-bridging"),
    ("slider --law none --a 0.01", "--a is not used here"),
    ("slider --law none --friction dieterich-ruina", "--law none"),
    (
        "slider --checkpoint-every 5",
        "--checkpoint-every is not used here",
    ),
    ("slider --restart none.bin --until 0.001", "none.bin"),
    (
        "slider --body reduced --frequency 1 --refinements 1",
        "raise --frequency",
    ),
    (
        "slider --until 0.1 --adaptive 1e-12 --max-steps 3 --refinements 1",
        "raise the tolerance",
    ),
    ("slider extra", "`extra`"),
];

const SPRING: [Wrong; 17] = [
    ("spring-slider --dt 0.1 --tolerance 1e-3", "--tolerance"),
    ("spring-slider --dt 1e3", "--dt 1000"),
    ("spring-slider --tolerance 0", "--tolerance"),
    (
        "spring-slider velocity-step --preset stick-slip",
        "--preset",
    ),
    ("spring-slider nothing", "PRESET"),
    ("spring-slider --hold 5", "--hold"),
    ("spring-slider --hold 5,2", "--hold"),
    ("spring-slider --law none --b 0.1", "--b is not used here"),
    (
        "spring-slider --law none --initial-theta 3",
        "--initial-theta is not used here",
    ),
    (
        "spring-slider --friction tresca --slip-distance 1",
        "--slip-distance is not used here",
    ),
    (
        "spring-slider --friction tresca --law ruina --a 0.01",
        "--a is not used here",
    ),
    ("spring-slider --every 0", "--every"),
    ("spring-slider --until=-1", "--until"),
    ("spring-slider --step-to=-1", "--step-to"),
    (
        "spring-slider --normal-stress 0",
        "change the initial slip rate",
    ),
    ("spring-slider --stiffness inf", "--stiffness"),
    ("spring-slider --b 0.5", "add mass or radiation damping"),
];

const FIT: [Wrong; 25] = [
    ("fit", "FILE"),
    ("fit none.csv", "none.csv"),
    ("fit Cargo.toml", "Cargo.toml, line 1, cell 1"),
    ("fit DATA --columns a,b", "no column `a`"),
    ("fit DATA --columns 1,2,3,4", "no column `4`"),
    ("fit DATA --columns time,friction", "--columns"),
    ("fit DATA --steps 0", "--steps"),
    ("fit DATA --steps a:b", "--steps"),
    ("fit DATA --fix mu=0.6", "--fix"),
    ("fit DATA --fix a", "--fix"),
    ("fit DATA --fix a=-1", "--fix"),
    ("fit DATA --fix k=1500 --stiffness 1500", "--fix k"),
    ("fit DATA --bounds a=1", "--bounds"),
    ("fit DATA --bounds a=2:1", "--bounds"),
    ("fit DATA --guess k=-5", "--guess"),
    ("fit DATA --delimiter x", "--delimiter"),
    ("fit DATA --skip many", "--skip"),
    ("fit DATA --skip 1000", "--skip"),
    ("fit DATA --window 9:3", "--window"),
    (
        "fit DATA --window 7e3:8e3 --displacement-unit 1e-6",
        "--window 7000:8000",
    ),
    ("fit DATA --weights none", "no column `none`"),
    ("fit DATA --law slip,aging,slip", "--law"),
    ("fit DATA --displacement-unit 0", "--displacement-unit"),
    ("fit DATA --stiffness 0", "--stiffness"),
    (
        "fit DATA --steps 0:1e-6,60:1e-5 --resolution 1e-8",
        "--resolution is not used here",
    ),
];

const INJECTION: [Wrong; 20] = [
    ("injection --cell 7 --length 100", "--cell 7"),
    ("injection --cell 1e-9 --length 1", "--cell"),
    ("injection --line --width 5", "--width"),
    ("injection --line --poisson-ratio 0.2", "--poisson-ratio"),
    ("injection --wells none.csv", "none.csv"),
    ("injection --wells Cargo.toml", "Cargo.toml, line 1, cell 1"),
    ("injection --wells none.csv --rate 1", "--rate"),
    ("injection --wells none.csv --shut-in 1", "--shut-in"),
    ("injection --rates constant", "--wells"),
    ("injection --rate nan", "--rate"),
    ("injection --rate 1", "--least-normal-stress PA"),
    ("injection --constant-friction 0.6 --a 0.01", "--a"),
    (
        "injection --constant-friction 0.6 --adaptive 1",
        "--adaptive",
    ),
    (
        "injection --constant-friction 0.6 --cell 1 --length 200 --width 100",
        "raise --cell",
    ),
    ("injection --steps 5", "--constant-friction"),
    ("injection --permeability 0", "--permeability"),
    ("injection --station 1,2,3", "--station"),
    ("injection --station 1e4,0", "is not on the fault"),
    ("injection --line --station 0,5", "is not on the fault"),
    ("injection --shear-stress 0", "--shear-stress"),
];

const OTHERS: [Wrong; 54] = [
    ("earthquakes --problem bp9", "--problem"),
    ("earthquakes --cell 333", "--cell 333"),
    ("earthquakes --cell 1e-9", "--cell"),
    ("earthquakes --years 0", "--years"),
    ("earthquakes --adaptive 0", "--adaptive"),
    (
        "earthquakes --problem bp1 --dip 30",
        "--dip is not a setting of bp1",
    ),
    ("earthquakes --problem bp3 --dip 120", "--dip"),
    ("earthquakes --problem bp5 --components 3", "--components"),
    ("earthquakes --problem bp7 --pressure solver", "--pressure"),
    ("earthquakes --problem bp8 --refine 2", "--refine"),
    (
        "earthquakes --problem bp8 --cell 40 --source well",
        "--least-normal-stress PA",
    ),
    (
        "earthquakes --problem bp5 --method implicit",
        "--method implicit",
    ),
    ("gmsh none.msh", "none.msh"),
    ("gmsh README.md", "README.md: line 1"),
    ("gmsh MESH --contact nothing", "--contact nothing"),
    ("gmsh MESH --driven nothing", "--driven nothing"),
    ("gmsh MESH --fixed nothing", "--fixed nothing"),
    ("gmsh MESH --direction 0,1", "--direction"),
    ("gmsh MESH --direction 1,0,0", "--direction"),
    ("gmsh MESH --direction 0,0", "--direction"),
    ("gmsh MESH --probe 1", "--probe: 1 number for"),
    ("gmsh MESH --compression 1 --direction 1,0", "--compression"),
    (
        "gmsh MESH --compression 1 --direction 1,0 --density 5",
        "--density is not used here",
    ),
    (
        "gmsh MESH --compression 1 --direction 1,0 --no-gravity",
        "--no-gravity is not used here",
    ),
    ("gmsh MESH --normal-stress=-1", "--normal-stress"),
    (
        "gmsh MESH --friction coulomb --b 0.1",
        "--b is not used here",
    ),
    ("gmsh MESH --opposite top", "--opposite is not used here"),
    ("sweep --sets 0", "--sets"),
    ("sweep --frequency 1 --refinements 1", "raise --frequency"),
    ("sweep --refinements 0", "--refinements"),
    ("rupture --cell 0", "--cell"),
    ("rupture --growth=-1", "--growth"),
    ("rupture --scheme newmark", "--scheme"),
    ("rupture --problem tpv7", "--problem"),
    ("rupture --relaxation-distance 0", "--relaxation-distance"),
    (
        "rupture --relaxation-velocity 1",
        "--relaxation-velocity is not used here",
    ),
    (
        "rupture --problem tpv6 --scheme implicit",
        "--scheme is not used here",
    ),
    ("rupture3d --problem tpv6", "--problem"),
    ("rupture3d --cell=-1", "--cell"),
    ("rupture3d --margin 0", "--margin"),
    ("rupture3d --damping=-1", "--damping"),
    ("rupture3d --station 3", "comma"),
    ("rupture3d --station 3,nan", "--station"),
    ("rupture3d --cell 1", "GiB are available"),
    (
        "rupture3d --cell 5000 --station 0,90e3",
        "outside the fault",
    ),
    ("rupture3d --mesh MESH", "dimension 3"),
    ("rupture3d --mesh MESH --cell 9", "--mesh"),
    ("rupture3d --vtu-every 3 --restart FILE", "--restart"),
    ("layer --law none", "--law"),
    ("layer --every 0", "--every"),
    ("slider3d --degrees nan", "--degrees"),
    ("slider3d --until 2", "--until"),
    ("figures 9.9", "FIGURE"),
    ("nothing", "nothing"),
];

/// Every command refuses a file as its folder before it runs.
const COMMANDS: [&str; 12] = [
    "slider",
    "figures 6.1",
    "fit DATA",
    "earthquakes",
    "injection",
    "gmsh MESH",
    "sweep",
    "rupture",
    "rupture3d",
    "layer",
    "spring-slider",
    "slider3d",
];

fn words(line: &str, out: &Path) -> Vec<OsString> {
    let word = |word: &str| match word {
        "DATA" => "../../examples/data/steps-and-holds.csv".into(),
        "MESH" => "../../examples/meshes/slider.msh".into(),
        _ => OsString::from(word),
    };
    let words = line.split_whitespace().map(word);
    let known = line != "nothing";
    let out = known.then(|| [OsString::from("--out"), out.into()]);
    words.chain(out.into_iter().flatten()).collect()
}

/// Names of Rust that no command line has.
fn has_names_of_rust(message: &str) -> bool {
    message.contains("::") || message.contains("with_") || message.contains("PerVertex")
}

fn refused(line: &str, out: &Path, expected: &str) -> Outcome {
    let words = words(line, out);
    let answer = catch_unwind(|| commands::answer(words)).map_err(|_| format!("panic: {line}"))?;
    let Err(refusal) = answer else {
        return Err(format!("accepted: {line}").into());
    };
    let message = refusal.message;
    assert_eq!(message.lines().count(), 1, "{line}: {message}");
    assert!(message.starts_with("error: "), "{line}: {message}");
    assert!(
        message.replace('\'', "`").contains(expected),
        "{line}: {message}"
    );
    assert!(!has_names_of_rust(&message), "{line}: {message}");
    Ok(())
}

#[test]
fn wrong_input_is_one_line_in_words_of_the_command_line() -> Outcome {
    let out = folder("wrong-input")?;
    for (line, expected) in SLIDER
        .iter()
        .chain(&SPRING)
        .chain(&FIT)
        .chain(&INJECTION)
        .chain(&OTHERS)
    {
        refused(line, &out, expected)?;
    }
    Ok(())
}

#[test]
fn a_file_in_place_of_a_folder_is_refused_before_a_run() -> Outcome {
    let file = folder("wrong-out")?.join("file");
    std::fs::write(&file, "text")?;
    for line in COMMANDS {
        refused(line, &file, "--out")?;
        refused(line, &file.join("folder"), "--out")?;
    }
    Ok(())
}
