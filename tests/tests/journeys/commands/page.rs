//! What a Markdown page shows: commands, SQL and other blocks, in the order of the page.

/// What it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A command of the shell.
    Command,
    /// An SQL statement.
    Sql,
    /// Something else: a file, a rule, an answer.
    Block,
}

/// Something that a page shows.
#[derive(Debug)]
pub struct Item {
    pub kind: Kind,
    pub text: String,
    pub line: usize,
}

/// All of it, but what stands for others: `adit route SITE`, or a verb alone.
pub fn items(page: &str) -> Vec<Item> {
    let mut found = Vec::new();
    let mut lines = (1..).zip(page.lines());
    while let Some((line, text)) = lines.next() {
        if let Some(language) = text.strip_prefix("```") {
            let block: Vec<(usize, &str)> = lines.by_ref().take_while(|(_, text)| *text != "```").collect();
            match language {
                "sh" => commands(&block, &mut found),
                "sql" => found.push(Item { kind: Kind::Sql, text: joined(&block), line }),
                // Rust is run by `cargo test --doc`
                "rust" => {}
                _ => found.push(Item { kind: Kind::Block, text: joined(&block), line }),
            }
        } else {
            found.extend(text.split('`').skip(1).step_by(2).filter_map(|words| inline(words, line)));
        }
    }
    found
}

fn joined(block: &[(usize, &str)]) -> String {
    block.iter().flat_map(|(_, text)| [text, "\n"]).collect()
}

/// The commands of a block: one a line, or several lines that end in `\`.
fn commands(block: &[(usize, &str)], found: &mut Vec<Item>) {
    let mut begun: Option<Item> = None;
    for (line, text) in block {
        let mut item = begun.take().unwrap_or(Item { kind: Kind::Command, text: String::new(), line: *line });
        item.text.push_str(text);
        if text.ends_with('\\') {
            item.text.push('\n');
            begun = Some(item);
        } else if !item.text.trim().is_empty() {
            found.push(item);
        }
    }
    assert!(begun.is_none(), "a block ends within a command");
}

fn inline(words: &str, line: usize) -> Option<Item> {
    let stands_for_another = |word: &str| {
        let letters: Vec<char> = word.chars().take_while(|c| *c != '.').collect();
        word.contains(['…', '[', ']']) || (letters.len() > 2 && letters.iter().all(char::is_ascii_uppercase))
    };
    let kind = if words.starts_with("SELECT ") {
        Kind::Sql
    } else {
        let mut all = words.split_whitespace();
        let is_program = matches!(all.next(), Some("adit" | "cargo"));
        let arguments: Vec<&str> = all.skip(1).collect();
        let is_whole = arguments.iter().any(|word| !word.starts_with('-'))
            && !arguments.iter().any(|word| stands_for_another(word));
        let is_script = words.starts_with("tests/") && (words.contains(".sh") || words == "tests/run");
        if !(is_program && is_whole || is_script) {
            return None;
        }
        Kind::Command
    };
    Some(Item { kind, text: words.to_owned(), line })
}
