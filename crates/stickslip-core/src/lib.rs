//! Functions that are generic in a number of components or of coordinates, 1, 2 or 3, and compiled in the crate that
//! declares them.
//!
//! A generic function is otherwise compiled by each program that calls it, with all that it calls: an engine of some
//! hundred thousand lines of machine code, at the optimisation level of the program. [`compiled!`] declares functions
//! whose bodies stand in tables of the declaring crate, one body for each number; a call reads the table.

#![cfg_attr(docsrs, feature(doc_cfg))]

// The program of the page of the package is compiled here.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

use std::any::Any;

/// Declares functions of a number `C`, which are compiled where they are declared, for 1, 2 and 3.
///
/// The number is that of a const parameter: `fn name<C>(..)` declares `fn name<const C: usize>(..)`. Arguments are names,
/// not patterns. Another number than 1, 2 or 3 does not compile.
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
        $visibility:vis fn $name:ident<$C:ident>($($argument:ident: $type:ty),* $(,)?) $(-> $result:ty)? $body:block
    )*) => {$(
        $(#[$meta])*
        #[inline]
        $visibility fn $name<const $C: usize>($($argument: $type),*) $(-> $result)? {
            fn compiled<const $C: usize>($($argument: $type),*) $(-> $result)? $body

            #[allow(clippy::type_complexity)]
            struct Door<const $C: usize>(fn($($type),*) $(-> $result)?);

            static DOORS: (Door<1>, Door<2>, Door<3>) =
                (Door(compiled::<1>), Door(compiled::<2>), Door(compiled::<3>));

            let door: &Door<$C> = $crate::door::<_, $C>([&DOORS.0, &DOORS.1, &DOORS.2]);
            (door.0)($($argument),*)
        }
    )*};
}

/// The entry of a table for `C`.
#[doc(hidden)]
#[inline]
pub fn door<Door: Any, const C: usize>(doors: [&'static dyn Any; 3]) -> &'static Door {
    const { assert!(1 <= C && C <= 3, "fields have 1, 2 or 3 components") };
    match doors[C - 1].downcast_ref() {
        Some(door) => door,
        None => unreachable!("the entries are in the order of their numbers"),
    }
}
