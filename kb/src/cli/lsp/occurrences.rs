//! Where names stand in a rule file, and what each of them names.

use std::collections::BTreeMap;
use std::ops::Range;

use super::tokens::{Kind, Token, tokens};

/// What a name stands for.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Named {
    Rule(String),
    Class(String),
    /// A property of a class.
    Property(String, String),
    /// A clause's variable, in the item that begins at this byte.
    Variable(usize, String),
    /// A function or constant of one file.
    Own(String),
}

/// What is done with a name where it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    Declared,
    /// Of a property: it is given a value.
    Set,
    Used,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occurrence {
    pub named: Named,
    pub role: Role,
    pub span: Range<usize>,
}

/// A rule, a revision, a reaction, a table or a declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Item {
    pub word: String,
    pub name: String,
    pub name_span: Range<usize>,
    pub span: Range<usize>,
    /// The variables of its clauses, with their classes.
    pub variables: BTreeMap<String, String>,
}

/// The names of one file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    pub items: Vec<Item>,
    pub occurrences: Vec<Occurrence>,
}

/// What files say of classes to each other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Classes {
    /// Classes by condition, with the class that each is of.
    pub parents: BTreeMap<String, String>,
    /// Properties that name an object, with its class.
    pub links: BTreeMap<(String, String), String>,
}

impl Classes {
    /// The class whose objects a class has.
    pub fn root<'c>(&'c self, class: &'c str) -> &'c str {
        let mut root = class;
        // classes that are of each other are the rules' mistake, and end here
        for _ in 0..=self.parents.len() {
            match self.parents.get(root) {
                Some(parent) => root = parent,
                None => break,
            }
        }
        root
    }

    /// The class of what `variable.link.link` names.
    pub fn along<'c>(&'c self, class: &'c str, links: &[&str]) -> Option<&'c str> {
        let mut class = self.root(class);
        for link in links {
            class = self.root(self.links.get(&(class.to_owned(), (*link).to_owned()))?);
        }
        Some(class)
    }

    /// Adds what a file declares.
    pub fn learn(&mut self, text: &str) {
        let tokens = code(text);
        for at in 0..tokens.len() {
            let word = |ahead: usize| tokens.get(at + ahead).filter(|token| token.kind == Kind::Name);
            let is = |ahead: usize, text: &str| tokens.get(at + ahead).is_some_and(|token| token.is(text));
            if let (true, Some(name), true, Some(parent)) = (is(0, "class"), word(1), is(2, "of"), word(3)) {
                self.parents.insert(name.text.to_owned(), parent.text.to_owned());
            }
            if let (true, Some(class), true, Some(property), true, Some(of)) =
                (is(0, "property"), word(1), is(2, "."), word(3), is(4, "names"), word(5))
            {
                let link = (class.text.to_owned(), property.text.to_owned());
                self.links.insert(link, of.text.to_owned());
            }
        }
    }
}

/// The words that begin an item and take a name in quotes.
const NAMED: [&str; 5] = ["rule", "revise", "on", "table", "without"];
/// The words that begin a clause.
pub const QUANTIFIERS: [&str; 8] = ["each", "some", "least", "most", "none", "all", "count", "sum"];

/// All tokens but comments.
pub fn code(text: &str) -> Vec<Token<'_>> {
    tokens(text).into_iter().filter(|token| token.kind != Kind::Comment).collect()
}

/// Reads the names of a file.
pub fn names(text: &str, classes: &Classes) -> Names {
    let tokens = code(text);
    let mut items = items(&tokens, text.len());
    let mut occurrences = Vec::new();
    for item in &mut items {
        let inside = tokens.iter().filter(|token| item.span.contains(&token.start));
        let inside: Vec<Token> = inside.copied().collect();
        Reader { item, tokens: &inside, classes, found: &mut occurrences }.read();
    }
    own(&tokens, &mut occurrences);
    occurrences.sort_by_key(|occurrence| (occurrence.span.start, occurrence.span.end));
    Names { items, occurrences }
}

fn items(tokens: &[Token], end: usize) -> Vec<Item> {
    let mut found: Vec<Item> = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let after = tokens.get(at + 1);
        let begins =
            token.kind == Kind::Name && !at.checked_sub(1).is_some_and(|before| tokens[before].is("."));
        let name = match token.text {
            word if NAMED.contains(&word) => {
                after.filter(|after| after.kind == Kind::Text).map(Token::inside)
            }
            "class" => after.filter(|after| after.kind == Kind::Name).map(Token::span),
            "property" => {
                let last = tokens.get(at + 3).filter(|last| last.kind == Kind::Name);
                let dotted = tokens.get(at + 2).is_some_and(|mark| mark.is("."));
                after.filter(|after| after.kind == Kind::Name).map(|after| {
                    after.start..last.filter(|_| dotted).map_or(after.span().end, |last| last.span().end)
                })
            }
            "fn" | "const" => after.filter(|after| after.kind == Kind::Name).map(Token::span),
            _ => None,
        };
        let Some(name_span) = name.filter(|_| begins) else { continue };
        if let Some(before) = found.last_mut() {
            before.span.end = token.start;
        }
        found.push(Item {
            word: token.text.to_owned(),
            name: text_of(tokens, &name_span),
            name_span,
            span: token.start..end,
            variables: BTreeMap::new(),
        });
    }
    found
}

fn text_of(tokens: &[Token], span: &Range<usize>) -> String {
    let within = tokens.iter().filter(|token| token.span().end > span.start && token.start < span.end);
    let cut = within.map(|token| {
        let from = span.start.saturating_sub(token.start);
        let to = token.text.len().min(span.end - token.start);
        &token.text[from..to]
    });
    cut.collect()
}

struct Reader<'r, 't> {
    item: &'r mut Item,
    tokens: &'r [Token<'t>],
    classes: &'r Classes,
    found: &'r mut Vec<Occurrence>,
}

impl Reader<'_, '_> {
    fn read(&mut self) {
        let name = self.item.name.clone();
        match self.item.word.as_str() {
            "without" => self.push(Named::Rule(name), Role::Used, self.item.name_span.clone()),
            word if NAMED.contains(&word) => {
                self.push(Named::Rule(name), Role::Declared, self.item.name_span.clone());
            }
            "class" => {
                self.push(Named::Class(name.clone()), Role::Declared, self.item.name_span.clone());
                self.class_by_condition(&name);
            }
            "property" => self.property(),
            _ => {}
        }
        self.clauses();
        self.chains();
    }

    fn push(&mut self, named: Named, role: Role, span: Range<usize>) {
        self.found.push(Occurrence { named, role, span });
    }

    fn name(&self, at: usize) -> Option<Token<'_>> {
        self.tokens.get(at).filter(|token| token.kind == Kind::Name).copied()
    }

    fn is(&self, at: usize, text: &str) -> bool {
        self.tokens.get(at).is_some_and(|token| token.is(text))
    }

    /// `class NAME of CLASS where …`: what stands bare behind it are properties of the class.
    fn class_by_condition(&mut self, name: &str) {
        if let Some((class, span)) = self.name(3).filter(|_| self.is(2, "of")).map(owned) {
            self.push(Named::Class(class), Role::Used, span);
        }
        let root = self.classes.root(name).to_owned();
        for at in 4..self.tokens.len() {
            let Some((word, span)) = self.name(at).map(owned) else { continue };
            let is_call = self.is(at + 1, "(");
            if !["where", "true", "false"].contains(&word.as_str()) && !self.is(at - 1, ".") && !is_call {
                self.push(Named::Property(root.clone(), word), Role::Used, span);
            }
        }
    }

    /// `property CLASS.NAME names CLASS`.
    fn property(&mut self) {
        let Some((class, span)) = self.name(1).map(owned) else { return };
        let root = self.classes.root(&class).to_owned();
        self.push(Named::Class(class), Role::Used, span);
        if let Some((property, span)) = self.name(3).filter(|_| self.is(2, ".")).map(owned) {
            self.push(Named::Property(root, property), Role::Declared, span);
        }
        if let Some((of, span)) = self.name(5).filter(|_| self.is(4, "names")).map(owned) {
            self.push(Named::Class(of), Role::Used, span);
        }
    }

    fn clauses(&mut self) {
        for at in 0..self.tokens.len() {
            let Some(word) = self.name(at) else { continue };
            if !QUANTIFIERS.contains(&word.text) || at > 0 && self.is(at - 1, ".") {
                continue;
            }
            let counted = self.is(at + 2, "of");
            let variable = at + if counted { 3 } else { 1 };
            let (Some(name), true) = (self.name(variable).map(owned), self.is(variable + 1, "in")) else {
                continue;
            };
            let class = self.name(variable + 2).map(owned);
            let begin = self.item.span.start;
            if counted && let Some((number, span)) = self.name(at + 1).map(owned) {
                self.push(Named::Variable(begin, number), Role::Declared, span);
            }
            self.push(Named::Variable(begin, name.0.clone()), Role::Declared, name.1);
            if let Some((class, span)) = class {
                self.item.variables.insert(name.0, class.clone());
                self.push(Named::Class(class), Role::Used, span);
            }
        }
    }

    /// `variable.link.property`, wherever it stands.
    fn chains(&mut self) {
        let begin = self.item.span.start;
        for at in 0..self.tokens.len() {
            let Some((variable, span)) = self.name(at).map(owned) else { continue };
            let is_field = at > 0 && self.is(at - 1, ".");
            let is_clause = self.is(at + 1, "in") || self.is(at + 1, "of");
            let declared = self.found.iter().any(|known| {
                known.role == Role::Declared && known.named == Named::Variable(begin, variable.clone())
            });
            if is_field || is_clause || !declared {
                continue;
            }
            self.push(Named::Variable(begin, variable.clone()), Role::Used, span);
            let Some(mut class) =
                self.item.variables.get(&variable).map(|class| self.classes.root(class).to_owned())
            else {
                continue;
            };
            let mut last = at;
            while let Some((property, span)) =
                self.name(last + 2).filter(|_| self.is(last + 1, ".")).map(owned)
            {
                last += 2;
                let role = if self.is_set(last) { Role::Set } else { Role::Used };
                let next = self.classes.along(&class, &[&property]).map(str::to_owned);
                self.push(Named::Property(class, property), role, span);
                match next {
                    Some(next) => class = next,
                    None => break,
                }
            }
        }
    }

    /// Whether what ends at this token is given a value: `x.p = …`, `x.p += …`, `set x.p by`, `set [ x.p ]`,
    /// `hypothesis x.p`.
    fn is_set(&self, last: usize) -> bool {
        let mark = |ahead: usize, text: &str| self.is(last + ahead, text);
        let assigned = mark(1, "=") && !mark(2, "=")
            || ["+", "-", "*", "/"].iter().any(|sign| mark(1, sign)) && mark(2, "=") && !mark(3, "=");
        let first = (0..last).rev().find(|&at| !(self.is(at, ".") || self.is(at + 1, "."))).unwrap_or(0);
        let listed = || {
            let open = (0..=first).rev().find(|&at| self.is(at, "[") || self.is(at, "]") || self.is(at, "}"));
            open.is_some_and(|open| self.is(open, "[") && open > 0 && self.is(open - 1, "set"))
        };
        assigned || self.is(first, "set") || self.is(first, "hypothesis") || listed()
    }
}

/// Functions and constants of the file, wherever they are called.
fn own(tokens: &[Token], found: &mut Vec<Occurrence>) {
    let before = |at: usize, word: &str| at > 0 && tokens[at - 1].is(word);
    let is_name = |token: &Token| token.kind == Kind::Name;
    let declared = |at: &usize| before(*at, "fn") || before(*at, "const");
    let names: Vec<&str> = (0..tokens.len())
        .filter(declared)
        .filter(|&at| is_name(&tokens[at]))
        .map(|at| tokens[at].text)
        .collect();
    for (at, token) in tokens.iter().enumerate() {
        if is_name(token) && names.contains(&token.text) && !before(at, ".") {
            let role = if declared(&at) { Role::Declared } else { Role::Used };
            found.push(Occurrence { named: Named::Own(token.text.to_owned()), role, span: token.span() });
        }
    }
}

fn owned(token: Token) -> (String, Range<usize>) {
    (token.text.to_owned(), token.span())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = r#"
class LOW of ROOMS where height < 1.5
property ROOMS.space names SPACES
fn twice(x) { x * 2 }
rule "a low room" priority 1
    each room in LOW where room.space.kind == "hall"
    count n of door in DOORS where door.room1 == room.room
    then { room.hardness = twice(n); }
table "t" first each door in DOORS given [ door.width ] set [ door.action, door.hardness ] rows [ [ any, "GO", 1.0 ] ]
revise "r" each room in ROOMS set room.hardness by * 2.0 level 1
without "an old one"
"#;

    fn read() -> Names {
        let mut classes = Classes::default();
        classes.learn(TEXT);
        names(TEXT, &classes)
    }

    fn all(named: &Named, role: Role) -> usize {
        read().occurrences.iter().filter(|found| found.named == *named && found.role == role).count()
    }

    fn property(class: &str, name: &str) -> Named {
        Named::Property(class.to_owned(), name.to_owned())
    }

    #[test]
    fn items_have_their_words_names_and_variables() {
        let items = read().items;
        let named: Vec<(&str, &str)> =
            items.iter().map(|item| (item.word.as_str(), item.name.as_str())).collect();
        assert_eq!(
            named,
            [
                ("class", "LOW"),
                ("property", "ROOMS.space"),
                ("fn", "twice"),
                ("rule", "a low room"),
                ("table", "t"),
                ("revise", "r"),
                ("without", "an old one")
            ]
        );
        assert_eq!(items[3].variables["room"], "LOW");
        assert_eq!(items[3].variables["door"], "DOORS");
    }

    #[test]
    fn properties_are_of_the_class_of_objects_and_of_what_links_name() {
        assert_eq!(all(&property("ROOMS", "height"), Role::Used), 1);
        assert_eq!(all(&property("ROOMS", "space"), Role::Used), 1);
        assert_eq!(all(&property("SPACES", "kind"), Role::Used), 1);
        assert_eq!(all(&property("ROOMS", "hardness"), Role::Set), 2);
        assert_eq!(all(&property("DOORS", "hardness"), Role::Set), 1);
        assert_eq!(all(&property("DOORS", "action"), Role::Set), 1);
        assert_eq!(all(&property("DOORS", "width"), Role::Used), 1);
    }

    #[test]
    fn rules_classes_functions_and_numbers_are_found_where_they_are_used() {
        assert_eq!(all(&Named::Rule("an old one".to_owned()), Role::Used), 1);
        assert_eq!(all(&Named::Class("LOW".to_owned()), Role::Used), 1);
        assert_eq!(all(&Named::Own("twice".to_owned()), Role::Used), 1);
        let begin = TEXT.find("rule \"a low").unwrap_or_default();
        assert_eq!(all(&Named::Variable(begin, "n".to_owned()), Role::Used), 1);
        assert_eq!(all(&Named::Variable(begin, "room".to_owned()), Role::Used), 3);
    }

    #[test]
    fn half_a_file_is_read_as_far_as_it_goes() {
        for end in (0..TEXT.len()).filter(|&end| TEXT.is_char_boundary(end)) {
            names(&TEXT[..end], &Classes::default());
        }
    }
}
