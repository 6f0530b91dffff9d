//! Where a bracket was opened that nothing closes.

use rhai::Position;

/// The first bracket of the kind that `closing` closes that stays open to the end of the text; what stands in texts and comments
/// opens nothing.
pub(super) fn bracket(text: &str, closing: &str) -> Option<Position> {
    let pairs = [(b'{', b'}'), (b'[', b']'), (b'(', b')')];
    let &(opens, closes) = pairs.iter().find(|(_, closes)| closing.as_bytes() == [*closes])?;
    let bytes = text.as_bytes();
    let (mut open, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        match &bytes[at..] {
            [b'/', b'/', ..] => at += text[at..].find('\n').unwrap_or(bytes.len() - at),
            [b'/', b'*', ..] => at += text[at..].find("*/").map_or(bytes.len() - at, |end| end + 2),
            [quote @ (b'"' | b'`'), ..] => at += end_of_text(&bytes[at..], *quote),
            [sign, ..] => {
                if *sign == opens {
                    open.push(at);
                } else if *sign == closes {
                    open.pop();
                }
                at += 1;
            }
            [] => break,
        }
    }
    let before = &text[..*open.first()?];
    let line = u16::try_from(before.matches('\n').count() + 1).ok()?;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    Some(Position::new(line, u16::try_from(column).ok()?))
}

/// How many bytes a text has, its quotes included.
fn end_of_text(bytes: &[u8], quote: u8) -> usize {
    let mut at = 1;
    while at < bytes.len() {
        match bytes[at] {
            b'\\' if quote == b'"' => at += 1,
            sign if sign == quote => return at + 1,
            _ => {}
        }
        at += 1;
    }
    at
}
