//! What holds for one errand only: what a robot keeps away from, what it carries, and when. Nothing of it is kept.

use std::sync::Arc;

use adit_db::{Store, Tx};
use adit_engine::RuleBase;
use adit_planners::facts::Column;
use jiff::SignedDuration;

use super::{Close, Edit};
use crate::answer::{self, Answer, Basis, Status};
use crate::error::{Code, Error, Result};
use crate::knowledge::KnowledgeBase;
use crate::knowledge::tables;
use crate::site::clock::stored;
use crate::state::{Nothing, State};
use crate::words::progress::Silent;

/// An errand may be said to be so long ago.
const LATE: SignedDuration = SignedDuration::from_secs(60);

/// What holds for one errand only.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Errand {
    /// What is closed to it: as edits close it, by name or at a point; or all areas of a kind.
    pub avoid: Vec<String>,
    /// What the robot carries.
    pub load: Option<String>,
    /// When it is, as [`KnowledgeBase::moment`] reads times.
    pub at: Option<String>,
    /// In which state it begins; in the cheapest where none is said.
    pub start_state: Option<String>,
    /// At which facing, in degrees, where that state is longer than wide.
    pub start_facing: Option<f64>,
    /// In which state it ends.
    pub goal_state: Option<String>,
}

impl Errand {
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// In which states it begins and ends.
    pub(crate) fn ends_in(&self) -> [Option<&str>; 2] {
        [self.start_state.as_deref(), self.goal_state.as_deref()]
    }

    /// An answer that says, too, what the errand keeps away from, where there is no route.
    pub(crate) fn explained(&self, mut answer: Answer) -> Answer {
        let is_avoiding = answer.status == Status::NoRoute && !self.avoid.is_empty();
        if let Some(reason) = answer.reason.as_mut().filter(|_| is_avoiding && self.ends_in() == [None; 2]) {
            let avoided: Vec<String> = self.avoid.iter().map(|what| format!("`{what}`")).collect();
            *reason = format!("{reason} (this errand keeps away from {})", avoided.join(", "));
        }
        answer
    }

    /// Has tables and facts say it, in a transaction that is taken back.
    pub(crate) fn tell(
        &self,
        tx: &mut Tx<'_>,
        (site, rules): (&KnowledgeBase, &RuleBase),
        robot: Option<&str>,
    ) -> Result<()> {
        let mut edits = Vec::new();
        for what in &self.avoid {
            let closed = of_kind(tx, what)?.into_iter();
            edits.extend(closed.map(|what| Edit::Close(Close { what, ..Close::default() })));
        }
        if let Some(load) = &self.load {
            let key = robot.map_or_else(|| load.clone(), |robot| format!("{robot}/{load}"));
            edits.push(Edit::Set("loads".to_owned(), key, "carried".to_owned(), "1".to_owned()));
        }
        for edit in edits {
            edit.apply(tx, site, rules, &KnowledgeBase::nobody())?;
        }
        Ok(())
    }
}

impl State {
    /// The route on an errand; nothing but this copy is changed.
    pub fn route_on_errand(
        self,
        errand: &Errand,
        (start, goals): (&str, &[String]),
        robot: Option<&str>,
    ) -> Result<Answer> {
        let now = self.site.clock().now();
        let state = self.on_errand(&[], errand, robot)?;
        let robot = answer::pick(&state.robots(), robot)?;
        let mut blank = Answer::blank(&robot, start, goals, state.generation);
        if let Some(at) = &errand.at {
            let then = state.site.clock().now();
            // who asks about this very moment may have another clock
            if then.duration_since(now) < -LATE {
                let message = format!("the errand is at {}, and that is over (`at` is `{at}`)", stored(then));
                return Err(Error::said(Code::RoutePast, message, None));
            }
            blank.remarks.push(format!("as it is at {} (`at` is `{at}`)", stored(then)));
        }
        let basis = Basis { ends_in: errand.ends_in(), start_facing: errand.start_facing, ..state.basis() };
        Ok(errand.explained(basis.search(goals, blank)?))
    }

    /// The best route to a goal on an errand after edits, which nobody keeps; where there is none, nothing is said of why.
    pub(crate) fn route_after(
        self,
        edits: &[Edit],
        errand: &Errand,
        (start, goal): (&str, &str),
        robot: &str,
    ) -> Result<Answer> {
        let state = self.on_errand(edits, errand, Some(robot))?;
        let goals = [goal.to_owned()];
        let blank = Answer::blank(robot, start, &goals, state.generation);
        let basis = Basis { ends_in: errand.ends_in(), start_facing: errand.start_facing, ..state.basis() };
        basis.found(&goals, blank).map(|(answer, _)| answer)
    }

    /// What is so after edits, which nobody keeps.
    pub(crate) fn after(self, edits: &[Edit]) -> Result<Self> {
        self.on_errand(edits, &Errand::default(), None)
    }

    /// What is so on an errand after edits, which are taken back with it.
    fn on_errand(mut self, edits: &[Edit], errand: &Errand, robot: Option<&str>) -> Result<Self> {
        if errand.at.is_some() {
            self.site = KnowledgeBase::clone(&self.site).at(errand.at.as_deref())?.shared();
        }
        let (site, rules) = (Arc::clone(&self.site), &self.inputs.rules);
        let told = Store::open(site.database())?.rehearse(|tx: &mut Tx<'_>| {
            for edit in edits {
                edit.apply(tx, &site, rules, &KnowledgeBase::nobody())?;
            }
            errand.tell(tx, (&site, rules), robot)?;
            site.told(tx, rules)
        })?;
        let step = self.step(told, &mut Nothing, &Silent)?;
        self.accept(step);
        Ok(self)
    }
}

/// The areas of a kind; of what is none, or has that name itself, only that.
fn of_kind(tx: &mut Tx<'_>, what: &str) -> Result<Vec<String>> {
    let areas = tables::kept(tx, "areas")?;
    let (Some(Column::Text(names)), Some(Column::Text(kinds))) = (areas.column("area"), areas.column("kind"))
    else {
        return Ok(vec![what.to_owned()]);
    };
    let is_name = names.iter().flatten().any(|name| name == what);
    let of_kind = names.iter().zip(kinds).filter(|(_, kind)| kind.as_deref() == Some(what));
    let of_kind: Vec<String> = of_kind.filter_map(|(name, _)| name.clone()).collect();
    Ok(if is_name || of_kind.is_empty() { vec![what.to_owned()] } else { of_kind })
}
