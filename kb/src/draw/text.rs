//! How long a text is, and how to make it fit.

/// Advance widths of Ubuntu Light from the space on, in thousandths of the font size.
const ADVANCES: [u16; 95] = [
    228, 274, 392, 653, 564, 831, 648, 240, 310, 310, 472, 564, 246, 282, 246, 359, 564, 564, 564, 564, 564,
    564, 564, 564, 564, 564, 246, 246, 564, 564, 564, 380, 940, 641, 630, 609, 702, 555, 520, 658, 692, 248,
    487, 599, 502, 865, 709, 774, 592, 774, 618, 517, 548, 680, 624, 921, 608, 569, 560, 310, 359, 310, 564,
    490, 376, 509, 583, 460, 583, 548, 376, 573, 569, 237, 237, 495, 255, 863, 569, 582, 583, 583, 374, 428,
    387, 569, 480, 775, 499, 474, 455, 319, 262, 319, 564,
];

/// Viewers without that font take another, mostly wider one.
const OTHER_FONTS: f64 = 1.1;

/// The width of a text of this size, rather too long than too short.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let advance = |c: char| {
        let index = (c as usize).checked_sub(32).and_then(|i| ADVANCES.get(i));
        index.map_or(1.0, |&a| f64::from(a) / 1000.0)
    };
    text.chars().map(advance).sum::<f64>() * size * OTHER_FONTS
}

/// The text, cut with an ellipsis where it is longer than `room`.
pub(super) fn fit(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut left = room - width("…", size);
    let mut short: String = text
        .chars()
        .take_while(|c| {
            left -= width(c.encode_utf8(&mut [0; 4]), size);
            left >= 0.0
        })
        .collect();
    short.truncate(short.trim_end_matches([' ', ',']).len());
    short.push('…');
    short
}

/// A number as people read it: three significant digits, no exponent in the usual range.
pub(super) fn figure(value: f64) -> String {
    let size = value.abs();
    let text = if size >= 1e6 || (size > 0.0 && size < 1e-3) {
        return format!("{value:.1e}");
    } else if size >= 99.95 {
        format!("{value:.0}")
    } else if size >= 9.995 {
        format!("{value:.1}")
    } else {
        format!("{value:.2}")
    };
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// The name of the n-th vertical strip, from 0: a, b, ... z, aa, ab, ...
pub(super) fn letters(n: usize) -> String {
    let mut rest = n + 1;
    let mut name = Vec::new();
    while rest > 0 {
        rest -= 1;
        name.push(char::from(b'a' + (rest % 26) as u8));
        rest /= 26;
    }
    name.iter().rev().collect()
}
