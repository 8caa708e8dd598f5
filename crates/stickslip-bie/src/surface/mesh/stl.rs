//! Surfaces of triangles from STL files, in text and binary.

use std::path::Path;

use super::super::SurfaceError;
use super::Triangles;

/// The bytes before the number of triangles in a binary file, and those of a triangle.
const HEADER: usize = 80;
const FACET: usize = 50;

impl Triangles {
    /// From an STL file, text or binary, in metres: points that coincide are merged, solids are sheets.
    ///
    /// Numbers of binary files have seven digits: 0.5 m at 4000 km north. Take coordinates from a near origin.
    ///
    /// # Errors
    /// [`SurfaceError::File`] for a file that cannot be read or is no STL file, and the errors of [`new`](Self::new).
    pub fn read_stl(path: impl AsRef<Path>) -> Result<Self, SurfaceError> {
        let path = path.as_ref();
        let failed = |place: String| SurfaceError::File {
            path: path.display().to_string(),
            place,
        };
        let bytes = std::fs::read(path).map_err(|error| failed(error.to_string()))?;
        Self::from_stl(&bytes).map_err(|error| match error {
            SurfaceError::File { place, .. } => failed(place),
            other => other,
        })
    }

    /// From the content of an STL file, see [`read_stl`](Self::read_stl).
    ///
    /// ```
    /// use stickslip_bie::Triangles;
    ///
    /// let text = "solid ramp
    ///   facet normal 0 0 1
    ///     outer loop
    ///       vertex 0 0 -1e3
    ///       vertex 1e3 0 -1e3
    ///       vertex 0 1e3 -2e3
    ///     endloop
    ///   endfacet
    /// endsolid ramp";
    /// assert_eq!(Triangles::from_stl(text.as_bytes())?.count(), 1);
    /// # Ok::<(), stickslip_bie::SurfaceError>(())
    /// ```
    ///
    /// # Errors
    /// See [`read_stl`](Self::read_stl).
    pub fn from_stl(bytes: &[u8]) -> Result<Self, SurfaceError> {
        // A binary header may begin with "solid", too: its length tells.
        let points = match binary_count(bytes) {
            Some(count) if bytes.len() == HEADER + 4 + count * FACET => binary(bytes),
            Some(count) if !bytes.trim_ascii_start().starts_with(b"solid") => {
                let expected = HEADER + 4 + count * FACET;
                return Err(broken(format!(
                    "{} bytes, where its header says {count} triangles, {expected} bytes",
                    bytes.len()
                )));
            }
            _ => text(bytes)?,
        };
        let triangles: Vec<_> = (0..points.len() / 3)
            .map(|cell| [0, 1, 2].map(|k| 3 * cell + k))
            .collect();
        Self::new(&points, &triangles)
    }
}

fn broken(place: String) -> SurfaceError {
    SurfaceError::File {
        path: "STL".to_owned(),
        place,
    }
}

/// The number of triangles in the header of a binary file.
fn binary_count(bytes: &[u8]) -> Option<usize> {
    let number = bytes.get(HEADER..HEADER + 4)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(number)).ok()
}

fn binary(bytes: &[u8]) -> Vec<[f64; 3]> {
    let facets = bytes[HEADER + 4..].chunks_exact(FACET);
    facets
        .flat_map(|facet| {
            // Behind the normal.
            let (numbers, _) = facet[12..48].as_chunks::<4>();
            let number = |k: usize| f64::from(f32::from_le_bytes(numbers[k]));
            [0, 3, 6].map(|k| [number(k), number(k + 1), number(k + 2)])
        })
        .collect()
}

fn text(bytes: &[u8]) -> Result<Vec<[f64; 3]>, SurfaceError> {
    let Ok(text) = str::from_utf8(bytes) else {
        return Err(broken(
            "neither text nor a whole binary STL file".to_owned(),
        ));
    };
    if !text.trim_start().starts_with("solid") {
        return Err(broken("no \"solid\" at its begin".to_owned()));
    }
    let (mut points, mut first, mut is_open) = (Vec::new(), 0, false);
    for (number, line) in text.lines().enumerate() {
        let line_number = number + 1;
        let mut words = line.split_whitespace();
        match words.next() {
            Some("vertex") => {
                let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
                let Ok(point) = <[f64; 3]>::try_from(numbers) else {
                    return Err(broken(format!(
                        "line {line_number}: a vertex must have 3 numbers: {}",
                        line.trim()
                    )));
                };
                points.push(point);
            }
            Some("endloop") => {
                if points.len() != first + 3 {
                    return Err(broken(format!(
                        "line {line_number}: a facet must have 3 vertices, has {}",
                        points.len() - first
                    )));
                }
                first = points.len();
            }
            Some("solid") => is_open = true,
            Some("endsolid") => is_open = false,
            _ => {}
        }
    }
    if is_open || points.len() != first {
        return Err(broken("no \"endsolid\" at its end".to_owned()));
    }
    Ok(points)
}
