//! Figures that a user may change: each with its name, its unit, and what it means.

/// Which numbers a figure may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// More than 0, and at most 10,000.
    Positive,
    /// From 0.01 to 10: how finely something is cut, which is what it costs.
    Grain,
    /// From 0 to 1,000,000.
    NotNegative,
    /// From 0 to 10: what is kept free, metres.
    Room,
    /// From 0 to 1.
    Share,
    /// 0, 1, 2, ... at most 1,000,000.
    Times,
    /// 1, 2, ... at most 1,000.
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
        let is_whole = number.fract() == 0.0;
        let (least, most, must) = match self {
            Self::Positive => (f64::MIN_POSITIVE, 1e4, "must be more than 0"),
            Self::Grain => (0.01, 10.0, "must be at least 0.01"),
            Self::NotNegative => (0.0, 1e6, "must not be negative"),
            Self::Room => (0.0, 10.0, "must not be negative"),
            Self::Share => (0.0, 1.0, "must not be negative"),
            Self::Times => (0.0, 1e6, "must be a whole number from 0 on"),
            Self::Count => (1.0, 1e3, "must be a whole number from 1 on"),
            Self::YesOrNo => (0.0, 1.0, "must be 1 (yes) or 0 (no)"),
        };
        let needs_whole = matches!(self, Self::Times | Self::Count | Self::YesOrNo);
        if number > most {
            return Some(match self {
                Self::Positive => "must be at most 10,000",
                Self::Grain | Self::Room => "must be at most 10",
                Self::Share => "must be at most 1",
                Self::NotNegative => "must be at most 1,000,000",
                Self::Count => "must be at most 1,000",
                Self::Times | Self::YesOrNo => must,
            });
        }
        let is_in = (least..=most).contains(&number) && (is_whole || !needs_whole);
        (!is_in).then_some(must)
    }
}

/// A figure of settings `S`.
#[derive(Clone, Copy, Debug)]
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
