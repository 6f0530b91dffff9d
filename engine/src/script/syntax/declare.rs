//! The grammar of `class` and `property`.

use super::shape::{At, Declaring, Next, Shape, Slot, found, wrong};
use super::word::Word;

impl Shape {
    pub(super) fn declared_name(&mut self) -> Next {
        let at = if self.item == Word::Class { Declaring::Of } else { Declaring::Dot };
        self.input(Slot::Name(self.item), At::Declaring(at), "$ident$")
    }

    pub(super) fn declaring(&mut self, at: Declaring, ahead: &str) -> Next {
        use Declaring::{
            AfterLink, AfterParent, AfterProperty, AfterSource, Ask, Condition, Default, Dot, Link, LinkKey,
            Of, Parent, Property, Source,
        };
        match (at, ahead) {
            (Of, "of") => self.word("of", At::Declaring(Parent)),
            (Of, _) => {
                let example = "`class LOW_DOORS of DOORS where height < 1.5`";
                wrong(format!("`of` and a class belong here, as in {example}, not {}", found(ahead)))
            }
            (Parent, _) => self.input(Slot::Parent, At::Declaring(AfterParent), "$ident$"),
            (AfterParent, "where") => self.word("where", At::Declaring(Condition)),
            (AfterParent, _) => wrong(format!(
                "`where` and what makes an object one of them belong here, not {}",
                found(ahead)
            )),
            (Condition, _) => self.input(Slot::Where, At::End, "$expr$"),
            (Dot, ".") => self.word(".", At::Declaring(Property)),
            (Dot, _) => {
                wrong(format!("`.` and a property belong here, as in `DOORS.width`, not {}", found(ahead)))
            }
            (Property, _) => self.input(Slot::Declared, At::Declaring(AfterProperty), "$ident$"),
            (AfterProperty, "names") => self.word("names", At::Declaring(Link)),
            (AfterProperty | AfterLink, "from") => self.word("from", At::Declaring(Source)),
            (AfterProperty, _) => wrong(format!(
                "`from` and its sources, or `names` and a class, belong here, not {}",
                found(ahead)
            )),
            (Link, _) => self.input(Slot::LinkClass, At::Declaring(AfterLink), "$ident$"),
            (AfterLink, ".") => self.word(".", At::Declaring(LinkKey)),
            (LinkKey, _) => self.input(Slot::LinkKey, At::Declaring(AfterLink), "$ident$"),
            (Source, "table" | "planner" | "rule") => {
                self.input(Slot::Source, At::Declaring(AfterSource), "$token$")
            }
            (Source, "ask") => self.word("ask", At::Declaring(Ask)),
            (Source, "default") => self.word("default", At::Declaring(Default)),
            (Source, _) => wrong(format!(
                "a property comes from table, planner, rule, default or ask, not from {}",
                found(ahead)
            )),
            (Ask, _) => self.input(Slot::Ask, At::Declaring(AfterSource), "$string$"),
            (Default, _) => self.input(Slot::Default, At::Declaring(AfterSource), "$expr$"),
            (AfterSource, ",") => self.word(",", At::Declaring(Source)),
            (AfterLink | AfterSource, _) => {
                self.at = At::End;
                self.next_item(ahead)
            }
        }
    }
}
