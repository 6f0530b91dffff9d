//! Figures that a user may change: each with its name, its unit, and what it means.

/// Which numbers a figure may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// More than 0.
    Positive,
    /// 0 or more.
    NotNegative,
    /// 0, 1, 2, ...
    Times,
    /// 1, 2, ...
    Count,
    /// 1 for yes, 0 for no.
    YesOrNo,
}

impl Range {
    /// What a number that is not among these must be, as the end of a sentence.
    ///
    /// # Returns
    /// `None` where it is among them.
    pub fn refuses(self, number: f64) -> Option<&'static str> {
        let is_whole = number.fract() == 0.0 && number <= f64::from(u32::MAX);
        let (is_in, must) = match self {
            Self::Positive => (number > 0.0, "must be more than 0"),
            Self::NotNegative => (number >= 0.0, "must not be negative"),
            Self::Times => (is_whole && number >= 0.0, "must be a whole number from 0 on"),
            Self::Count => (is_whole && number >= 1.0, "must be a whole number from 1 on"),
            Self::YesOrNo => (is_whole && (0.0..=1.0).contains(&number), "must be 1 (yes) or 0 (no)"),
        };
        (!(is_in && number.is_finite())).then_some(must)
    }
}

/// A figure of settings `S`.
#[derive(Debug)]
pub struct Figure<S: 'static> {
    /// Its name.
    pub name: &'static str,
    /// Its unit, as `m`; empty where it has none.
    pub unit: &'static str,
    /// What it means, as a sentence.
    pub meaning: &'static str,
    /// Which numbers it may be.
    pub range: Range,
    /// Its number in that unit.
    pub of: fn(&S) -> f64,
    /// Takes a number in that unit, of that range.
    pub set: fn(&mut S, f64),
}

/// Settings with their defaults and their [`Figure`]s. A field is `metres: f64`, an angle in radians (`degrees`, whose
/// number is in degrees), a whole number of some type, or `bool`.
macro_rules! settings {
    (
        $(#[$of:meta])*
        pub struct $Settings:ident {
            others {
                $( $(#[$plain_of:meta])* $plain:ident : $type:ty = $its:expr; )*
            }
            figures {
                $( $field:ident : $kind:ident = $default:literal, $name:literal, $unit:literal, $range:ident, $meaning:literal; )*
            }
        }
    ) => {
        $(#[$of])*
        pub struct $Settings {
            $( $(#[$plain_of])* pub $plain: $type, )*
            $( #[doc = $meaning] pub $field: $crate::figures::settings!(@type $kind), )*
        }

        impl Default for $Settings {
            fn default() -> Self {
                Self {
                    $( $plain: $its, )*
                    $( $field: $crate::figures::settings!(@default $kind, $default), )*
                }
            }
        }

        impl $Settings {
            /// What of it users may change.
            pub const FIGURES: &'static [$crate::figures::Figure<Self>] = &[
                $( $crate::figures::Figure {
                    name: $name,
                    unit: $unit,
                    meaning: $meaning,
                    range: $crate::figures::Range::$range,
                    of: |settings| $crate::figures::settings!(@of $kind, settings.$field),
                    set: |settings, number| settings.$field = $crate::figures::settings!(@from $kind, number),
                }, )*
            ];
        }
    };
    (@type degrees) => { f64 };
    (@type $type:ident) => { $type };
    (@default degrees, $default:literal) => { f64::to_radians($default) };
    (@default $type:ident, $default:literal) => { $default };
    (@of f64, $field:expr) => { $field };
    (@of degrees, $field:expr) => { $field.to_degrees() };
    (@of bool, $field:expr) => { f64::from(u8::from($field)) };
    (@of usize, $field:expr) => { $field as f64 };
    (@of $type:ident, $field:expr) => { f64::from($field) };
    (@from f64, $number:ident) => { $number };
    (@from degrees, $number:ident) => { $number.to_radians() };
    (@from bool, $number:ident) => { $number > 0.5 };
    (@from $type:ident, $number:ident) => { $number as $type };
}
pub(crate) use settings;
