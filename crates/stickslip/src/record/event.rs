//! The source parameters of an event.

use super::table::Entry;

/// An event of a contact, from the time at which its largest slip rate passes the threshold until it falls below
/// the rate at which the next event may begin.
///
/// The *extent* is the set of vertices whose slip rate exceeded the threshold in the meantime. Sums over vertices have
/// their areas as weights `w`. For each vertex, `s` is its slip in the event, the length of the change of its slip vector, `tau` the modulus of its shear traction,
/// and `tau_0`, `tau_1` the values before and after the event, the latter in the direction of the former:
///
/// ```text
/// moment         G  sum over the extent of w s
/// stress drop    sum over the extent of w (tau_0 - tau_1) / sum over the extent of w
/// friction work  sum over the steps and the contact of w (tau_begin + tau_end)/2 ds along the path
/// released       sum over the contact of w (tau_0 + tau_1)/2 s
/// pressure       sum over the extent of w (p_1 - p_0) / sum over the extent of w
/// ```
///
/// *Before* is the last step below the threshold, *after* the first one below the other rate, and slip is counted
/// between these. `released` is the energy that an elastic body transfers to its contact if its boundary does not move
/// meanwhile (B. Kostrov, Izv. Earth Physics 1 (1974)). Less the friction work, it is the radiated energy; a negative
/// value is energy that the driven boundary has added. All are per metre of depth for a plane body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Event {
    /// The time at which the largest slip rate exceeded the threshold \[s\], its logarithm interpolated within the
    /// step.
    pub onset: f64,
    /// The time at which it fell below the rate that ends an event \[s\], likewise; NaN for an event in progress.
    pub arrest: f64,
    /// The first vertex of the body that exceeded the threshold.
    pub origin: usize,
    /// The hypocentre: the position of this vertex \[m\]; along a planar fault by boundary integrals its first one or
    /// two coordinates are positions on the fault.
    pub hypocentre: [f64; 3],
    /// The largest slip rate at the end of a step [m/s].
    pub peak_slip_rate: f64,
    /// The time of the largest slip rate \[s\].
    pub peak_time: f64,
    /// The vertex of the body with the largest slip rate.
    pub peak_vertex: usize,
    /// The number of vertices in the extent.
    pub vertices: usize,
    /// The least coordinates of the extent \[m\].
    pub low: [f64; 3],
    /// The largest coordinates of the extent \[m\].
    pub high: [f64; 3],
    /// The area of the extent [m^2; m in 2D].
    pub area: f64,
    /// The largest slip \[m\].
    pub largest_slip: f64,
    /// The mean slip over the extent \[m\].
    pub mean_slip: f64,
    /// The moment [N m; N in 2D, per metre of depth].
    pub moment: f64,
    /// The mean stress drop over the extent \[Pa\].
    pub stress_drop: f64,
    /// The frictional work [J; J/m in 2D].
    pub friction_work: f64,
    /// The energy released [J; J/m in 2D].
    pub released: f64,
    /// The mean change of the pore pressure over the extent \[Pa\]; 0 without fields.
    pub pressure_change: f64,
}

impl Event {
    /// The names of [`entries`](Self::entries), for a [`Table`](crate::record::Table).
    pub const COLUMNS: [&str; 24] = [
        "onset",
        "arrest",
        "origin",
        "hypocentre_x",
        "hypocentre_y",
        "hypocentre_z",
        "peak_slip_rate",
        "peak_time",
        "peak_vertex",
        "vertices",
        "low_x",
        "low_y",
        "low_z",
        "high_x",
        "high_y",
        "high_z",
        "area",
        "largest_slip",
        "mean_slip",
        "moment",
        "stress_drop",
        "friction_work",
        "released",
        "pressure_change",
    ];

    /// The values of the event, in the order of the fields.
    pub fn entries(&self) -> [Entry; 24] {
        let ([a, b, c], [d, e, f]) = (self.low, self.high);
        let [x, y, z] = self.hypocentre;
        [
            self.onset.into(),
            self.arrest.into(),
            self.origin.into(),
            x.into(),
            y.into(),
            z.into(),
            self.peak_slip_rate.into(),
            self.peak_time.into(),
            self.peak_vertex.into(),
            self.vertices.into(),
            a.into(),
            b.into(),
            c.into(),
            d.into(),
            e.into(),
            f.into(),
            self.area.into(),
            self.largest_slip.into(),
            self.mean_slip.into(),
            self.moment.into(),
            self.stress_drop.into(),
            self.friction_work.into(),
            self.released.into(),
            self.pressure_change.into(),
        ]
    }
}
