//! The memory of the machine.

/// Bytes of 1 GiB.
pub const GIB: f64 = 1024.0 * 1024.0 * 1024.0;

/// The memory that programs can still take \[byte\], where the system tells: `MemAvailable` of Linux.
pub fn available() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("MemAvailable"))?;
    let kibibytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kibibytes)
}
