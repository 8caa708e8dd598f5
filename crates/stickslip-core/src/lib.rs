//! Functions that are generic in a number of components or of coordinates, 1, 2 or 3, and compiled in the crate that
//! declares them.
//!
//! A generic function is otherwise compiled by each program that calls it, with all that it calls: an engine of some
//! hundred thousand lines of machine code, at the optimisation level of the program. [`compiled!`] declares functions
//! whose bodies stand in the declaring crate, one for each number; a call chooses among them.
//!
//! [`lanes`] has passes over many numbers, several of them per instruction. [`MOST_LEVELS`] bounds the levels of local steps.

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

pub mod lanes;

use std::any::Any;

/// The most levels of local steps of a stiffness; cells of level `l` act every `2^l`-th step.
///
/// The weights of the levels in a step stand in an array of this length: no step allocates memory for them. A force of a level
/// beyond it would be lost, so a scene refuses a matrix of more levels. The slowest cells of 16 levels act every 32 768-th step,
/// which is a ratio of edges that no mesh has.
pub const MOST_LEVELS: usize = 16;

/// Declares functions of a number `C`, which are compiled where they are declared, for 1, 2 and 3, or those named: `C in
/// 2, 3`.
///
/// The number is that of a const parameter: `fn name<C>(..)` declares `fn name<const C: usize>(..)`. Arguments are names,
/// not patterns. A call with another number panics.
///
/// ```
/// stickslip_core::compiled! {
///     /// The sum of the squares of the components.
///     pub fn square<C>(components: &[f64; C]) -> f64 {
///         components.iter().map(|x| x * x).sum()
///     }
/// }
///
/// assert_eq!(square(&[3.0, 4.0]), 25.0);
/// ```
#[macro_export]
macro_rules! compiled {
    ($(
        $(#[$meta:meta])*
        $visibility:vis fn $name:ident<$C:ident $(in $($number:literal),+)?>(
            $($argument:ident: $type:ty),* $(,)?
        ) $(-> $result:ty)? $body:block
    )*) => {$(
        $(#[$meta])*
        #[inline]
        $visibility fn $name<const $C: usize>($($argument: $type),*) $(-> $result)? {
            fn compiled<const $C: usize>($($argument: $type),*) $(-> $result)? $body

            #[allow(clippy::type_complexity)]
            struct Door<const $C: usize>(fn($($type),*) $(-> $result)?);

            let door: &Door<$C> = $crate::door($crate::doors!($C, compiled, Door $(, $($number),+)?));
            (door.0)($($argument),*)
        }
    )*};
}

/// The entry of a function for `C`, of 1, 2 and 3 by default. A match on a constant: a program links what it calls.
#[doc(hidden)]
#[macro_export]
macro_rules! doors {
    ($C:ident, $function:ident, $Door:ident) => {
        $crate::doors!($C, $function, $Door, 1, 2, 3)
    };
    ($C:ident, $function:ident, $Door:ident, $($number:literal),+) => {
        match $C {
            $($number => {
                static DOOR: $Door<$number> = $Door($function::<$number>);
                &DOOR
            })+
            _ => &(),
        }
    };
}

/// The entry of a function.
///
/// # Panics
/// If the function is called with a number that it is not compiled for.
#[doc(hidden)]
#[inline]
pub fn door<Door: Any>(door: &'static dyn Any) -> &'static Door {
    match door.downcast_ref() {
        Some(door) => door,
        None => panic!("this function is for other numbers of components or coordinates"),
    }
}
