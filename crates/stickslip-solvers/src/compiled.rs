//! Functions that are generic in the number of components, compiled in the crate that has them.

use std::any::Any;

/// Declares functions of a number of components `C`, which are compiled where they are declared, for 1, 2 and 3: a call
/// from another crate compiles nothing but the call.
///
/// ```
/// stickslip_solvers::compiled! {
///     /// The sum of the squares of the components.
///     pub fn square<C>(components: &[f64; C]) -> f64 {
///         components.iter().map(|x| x * x).sum()
///     }
/// }
///
/// assert_eq!(square(&[3.0, 4.0]), 25.0);
/// ```
#[doc(hidden)]
#[macro_export]
macro_rules! compiled {
    ($(
        $(#[$meta:meta])*
        $visibility:vis fn $name:ident<$C:ident>($($argument:ident: $type:ty),* $(,)?) $(-> $result:ty)? $body:block
    )*) => {$(
        $(#[$meta])*
        #[inline]
        $visibility fn $name<const $C: usize>($($argument: $type),*) $(-> $result)? {
            #[allow(clippy::too_many_arguments, clippy::type_complexity)]
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

/// The door for `C` components.
#[doc(hidden)]
#[inline]
pub fn door<Door: Any, const C: usize>(doors: [&'static dyn Any; 3]) -> &'static Door {
    const { assert!(1 <= C && C <= 3, "fields have 1, 2 or 3 components") };
    match doors[C - 1].downcast_ref() {
        Some(door) => door,
        None => unreachable!("doors are in the order of their components"),
    }
}
