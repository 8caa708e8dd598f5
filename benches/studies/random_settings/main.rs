//! Does the slider's command line hold at settings that nobody has tried?
//!
//! Runs the example at random settings, all flags among them, extreme and wrong values too. Each run
//! has to end with status 0, or with another one and a single line on stderr, and its summary.json
//! holds no number that is none. Those that take too long are stopped, and named.
//!
//! ```text
//! cargo build --release --example slider
//! cargo run --release --manifest-path benches/studies/Cargo.toml --bin random_settings -- target/release/examples/slider
//! ```

mod settings;

use std::fs::{File, read_to_string, remove_dir_all};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitCode, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use clap::Parser;
use stickslip_cli::cli::{self, Problem};
use stickslip_studies::Draws;

const SUMMARY: &str = "summary.json";
const STDERR: &str = "stderr.txt";
/// The entries of summary.json that may be null.
const MAY_BE_NULL: [&str; 4] = [
    "\"failure\":",
    "\"first_slip_time\":",
    "\"frequency\":",
    "\"modes\":",
];
/// Between two looks at a run.
const PAUSE: Duration = Duration::from_millis(5);

/// The slider at random settings; fails where one of them breaks a promise of the command line.
#[derive(Debug, Clone, Parser)]
#[command(name = "random_settings")]
struct Arguments {
    /// The example, built with optimisation
    slider: PathBuf,
    /// The first draw
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The number of settings
    #[arg(long, default_value_t = 500)]
    count: usize,
    /// The time that a run may take [s]
    #[arg(long, default_value_t = 20.0, value_parser = cli::positive)]
    limit: f64,
    /// The folder to write to; what a run leaves is kept if it breaks a promise
    #[arg(long, value_name = "DIR", default_value = "out/random_settings")]
    out: PathBuf,
}

/// The outcome of a run.
enum Ending {
    Solved,
    /// With one line on stderr: status 2 for the command line, 1 for what follows.
    Refused(i32),
    /// Not within the time that it may take.
    Late,
    /// A promise is broken.
    Broken(String),
}

fn main() -> ExitCode {
    cli::run(try_all)
}

fn try_all(arguments: &Arguments) -> Result<(), Problem> {
    let mut draws = Draws(arguments.seed);
    let mut counts = [0; 5];
    for n in 0..arguments.count {
        let settings = settings::draw(&mut draws);
        let folder = arguments.out.join(n.to_string());
        std::fs::create_dir_all(&folder)?;
        let (ending, text) = match try_one(arguments, &settings, &folder)? {
            Ending::Solved => (0, None),
            Ending::Refused(2) => (1, None),
            Ending::Refused(_) => (2, None),
            Ending::Late => (3, Some(format!("no end after {} s", arguments.limit))),
            Ending::Broken(text) => (4, Some(text)),
        };
        counts[ending] += 1;
        match text {
            Some(text) => println!("{n}: {text}\n    slider {}", settings.join(" ")),
            None => remove_dir_all(&folder)?,
        }
    }
    let [solved, refused, failed, late, broken] = counts;
    println!(
        "{} settings: {solved} run to their end, {refused} command lines refused, {failed} ended \
         with an error in one line, {late} took too long, {broken} broke a promise",
        arguments.count
    );
    if broken > 0 {
        return Err(format!("{broken} of {} settings", arguments.count).into());
    }
    Ok(())
}

fn try_one(arguments: &Arguments, settings: &[String], folder: &Path) -> Result<Ending, Problem> {
    let stderr = folder.join(STDERR);
    let mut slider = Command::new(&arguments.slider)
        .args(settings)
        .arg("--out")
        .arg(folder)
        .stdout(Stdio::null())
        .stderr(File::create(&stderr)?)
        .spawn()?;
    let Some(status) = wait(&mut slider, Duration::from_secs_f64(arguments.limit))? else {
        return Ok(Ending::Late);
    };
    let lines = read_to_string(stderr)?;
    // A run that ends before it writes leaves none.
    let summary = read_to_string(folder.join(SUMMARY)).unwrap_or_default();
    Ok(judge(status, &lines, &summary))
}

/// The status of a program that ends within `limit`; another one is stopped.
fn wait(child: &mut Child, limit: Duration) -> Result<Option<ExitStatus>, Problem> {
    let begin = Instant::now();
    while begin.elapsed() < limit {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        sleep(PAUSE);
    }
    child.kill()?;
    child.wait()?;
    Ok(None)
}

fn judge(status: ExitStatus, stderr: &str, summary: &str) -> Ending {
    // Numbers that are none are written as null.
    let mut fields = summary.lines().map(str::trim);
    let none = fields.find(|field| {
        field.contains("null") && !MAY_BE_NULL.iter().any(|name| field.starts_with(name))
    });
    let lines = stderr.lines().count();
    match (none, status.code()) {
        (Some(field), _) => Ending::Broken(format!("in {SUMMARY}: {field}")),
        (None, Some(0)) if summary.is_empty() => Ending::Broken(format!("no {SUMMARY}")),
        (None, Some(0)) if lines > 0 => Ending::Broken(format!("success, and says: {stderr}")),
        (None, Some(0)) => Ending::Solved,
        (None, Some(code @ (1 | 2))) if lines == 1 => Ending::Refused(code),
        (None, _) => Ending::Broken(format!("{status}, {lines} lines: {stderr}")),
    }
}
