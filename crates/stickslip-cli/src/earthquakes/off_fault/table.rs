//! The table of receivers.

use std::path::Path;

use csv::{Position, ReaderBuilder, Trim};

use super::super::Failed;

/// The names and the points `[x, y, z]` \[m\] of receivers.
pub(super) fn read(path: &Path) -> Result<(Vec<String>, Vec<[f64; 3]>), Failed> {
    let file = path.display();
    let text =
        std::fs::read_to_string(path).map_err(|cause| format!("cannot read {file}: {cause}"))?;
    of_text(&text).map_err(|problem| format!("{file}{problem}").into())
}

fn of_text(text: &str) -> Result<(Vec<String>, Vec<[f64; 3]>), String> {
    let mut table = ReaderBuilder::new()
        .trim(Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let columns = (table.headers().map_err(|error| format!(": {error}"))?).clone();
    let place = |name: &str| columns.iter().position(|column| column == name);
    let (Some(x), Some(z)) = (place("x"), place("z")) else {
        let found = columns.iter().collect::<Vec<_>>().join(",");
        return Err(format!(
            ": the first line is \"{found}\"; name the columns, x,y,z or x,z and, if wanted, name"
        ));
    };
    let (y, named) = (place("y"), place("name"));
    let (mut names, mut points) = (Vec::new(), Vec::new());
    for row in table.records() {
        let row = row.map_err(|error| format!(": {error}"))?;
        let line = row.position().map_or(0, Position::line);
        let number = |column: usize| {
            row[column].parse::<f64>().map_err(|_| {
                let (name, text) = (&columns[column], &row[column]);
                format!(", line {line}: {name} is \"{text}\", must be a number of metres")
            })
        };
        points.push([number(x)?, y.map_or(Ok(0.0), number)?, number(z)?]);
        let name = named.map_or("", |column| &row[column]);
        let is_file = |c: char| c.is_alphanumeric() || "+-_.".contains(c);
        if !name.chars().all(is_file) {
            return Err(format!(
                ", line {line}: name is \"{name}\", must be letters, digits and + - _ . alone: it names a file"
            ));
        }
        names.push(if name.is_empty() {
            format!("{:03}", names.len())
        } else {
            name.to_owned()
        });
    }
    if points.is_empty() {
        return Err(": the table has no row".into());
    }
    Ok((names, points))
}

#[cfg(test)]
mod tests {
    use super::of_text;

    #[test]
    fn columns_are_found_by_name() {
        let table = of_text("# stations\nname, z,x\nGPS1, 0,8e3\n\n,-1.5,-8000\n");
        let names = vec!["GPS1".to_owned(), "001".to_owned()];
        let points = vec![[8e3, 0.0, 0.0], [-8e3, 0.0, -1.5]];
        assert_eq!(table, Ok((names, points)));
        for (text, told) in [
            ("", "name the columns"),
            ("1,2,3\n", "name the columns"),
            ("x,y,z\n", "no row"),
            ("x,y,z\n1,2\n", "line: 2"),
            ("x,y,z\n1,2,b\n", "line 2: z is"),
            ("x,z,name\n1,2,../a\n", "line 2: name is"),
        ] {
            assert!(
                of_text(text).is_err_and(|error| error.contains(told)),
                "{text}"
            );
        }
    }
}
