//! ROS 2's actions: goals that run beside one another, are cancelled, and end with a result that may be asked for more than once.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use adit_site::say;
use ros2_client::action::{GetResultRequest, GetResultResponse, SendGoalRequest, SendGoalResponse};
use ros2_client::action_msgs::{
    CancelGoalRequest, CancelGoalResponse, CancelGoalResponseEnum as Cancel, GoalId, GoalInfo, GoalStatus,
    GoalStatusArray, GoalStatusEnum as Status,
};
use ros2_client::builtin_interfaces::Time;
use ros2_client::{ActionServer, Message, RmwRequestId};
use tokio::runtime::Handle;
use tokio::sync::watch;

use crate::ears::{Ears, drain, words};
use crate::presence::Presence;

/// How long a result is kept after the end.
const KEPT: Duration = Duration::from_mins(1);

/// So many goals run at once; more are rejected.
const AT_ONCE: usize = 256;

/// How a goal ended: as it was to, or not.
pub type Ended<R> = Result<R, R>;

/// An action's server, with its goals.
pub struct Actions<G: Message + Clone, R: Message + Clone, F: Message> {
    name: String,
    server: ActionServer<G, R, F>,
    presence: Arc<Presence>,
    goals: Mutex<BTreeMap<GoalId, Goal<R>>>,
}

struct Goal<R> {
    status: Status,
    accepted: Time,
    cancel: watch::Sender<bool>,
    result: Option<R>,
    /// Who waits for the result.
    waits: Vec<RmwRequestId>,
    ended: Option<Instant>,
}

impl<G, R, F> Actions<G, R, F>
where
    G: Message + Clone + Send + 'static,
    R: Message + Clone + Default + Send + 'static,
    F: Message + std::fmt::Debug + Send + 'static,
    ActionServer<G, R, F>: Send + Sync,
{
    /// Hears goals from now on; `run` does what one asks for.
    pub fn serve<D, W>(
        name: &str,
        mut server: ActionServer<G, R, F>,
        (ears, presence): (&mut Ears, Arc<Presence>),
        runtime: Handle,
        run: D,
    ) -> anyhow::Result<()>
    where
        D: Fn(G, Feedback<G, R, F>) -> W + Send + Sync + Clone + 'static,
        W: Future<Output = Ended<R>> + Send + 'static,
    {
        ears.wake_for(server.goal_server())?;
        ears.wake_for(server.cancel_server())?;
        ears.wake_for(server.result_server())?;
        let all = Arc::new(Self { name: name.to_owned(), server, presence, goals: Mutex::default() });
        let (goals, cancels, results) =
            (format!("{name}/send_goal"), format!("{name}/cancel_goal"), format!("{name}/get_result"));
        ears.then(Box::new(move || {
            drain(&goals, || all.server.receive_goal().map_err(words), &mut |(id, request): (
                _,
                SendGoalRequest<G>,
            )| {
                all.begin(id, request.goal_id, request.goal, &runtime, &run);
            });
            drain(&cancels, || all.server.receive_cancel_request().map_err(words), &mut |(id, request): (
                _,
                CancelGoalRequest,
            )| {
                all.cancel(id, &request);
            });
            drain(&results, || all.server.receive_result_request().map_err(words), &mut |(id, request): (
                _,
                GetResultRequest,
            )| {
                all.result(id, request.goal_id);
            });
        }));
        Ok(())
    }

    fn goals(&self) -> MutexGuard<'_, BTreeMap<GoalId, Goal<R>>> {
        self.goals.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn begin<D, W>(self: &Arc<Self>, request: RmwRequestId, id: GoalId, goal: G, runtime: &Handle, run: &D)
    where
        D: Fn(G, Feedback<G, R, F>) -> W + Send + Sync + Clone + 'static,
        W: Future<Output = Ended<R>> + Send + 'static,
    {
        let accepted = Time::now();
        let (cancel, cancelled) = watch::channel(false);
        let is_new = {
            let mut goals = self.goals();
            goals.retain(|_, goal| goal.ended.is_none_or(|ended| ended.elapsed() < KEPT));
            let running = goals.values().filter(|goal| goal.ended.is_none()).count();
            let is_new = running < AT_ONCE && !goals.contains_key(&id);
            if is_new {
                let goal = Goal {
                    status: Status::Executing,
                    accepted,
                    cancel,
                    result: None,
                    waits: Vec::new(),
                    ended: None,
                };
                goals.insert(id, goal);
            }
            is_new
        };
        self.answer(request, move |all| {
            let response = SendGoalResponse { accepted: is_new, stamp: accepted };
            all.sent(all.server.send_goal_response(request, response));
        });
        if !is_new {
            say(&format!("{}: a goal is rejected: its id is known, or {AT_ONCE} run already", self.name));
            return;
        }
        self.tell_statuses();
        let (all, run) = (Arc::clone(self), run.clone());
        runtime.spawn(async move {
            let feedback = Feedback { all: Arc::clone(&all), id };
            let mut cancelled = cancelled;
            let (status, result) = tokio::select! {
                ended = run(goal, feedback) => match ended {
                    Ok(result) => (Status::Succeeded, result),
                    Err(result) => (Status::Aborted, result),
                },
                _ = cancelled.wait_for(|is| *is) => (Status::Canceled, R::default()),
            };
            all.end(id, status, &result);
        });
    }

    fn end(self: &Arc<Self>, id: GoalId, status: Status, result: &R) {
        let waits = {
            let mut goals = self.goals();
            let Some(goal) = goals.get_mut(&id) else { return };
            goal.status = status;
            goal.result = Some(result.clone());
            goal.ended = Some(Instant::now());
            std::mem::take(&mut goal.waits)
        };
        for request in waits {
            self.tell_result(request, GetResultResponse { status, result: result.clone() });
        }
        self.tell_statuses();
    }

    fn tell_result(self: &Arc<Self>, request: RmwRequestId, answer: GetResultResponse<R>) {
        self.answer(request, move |all| {
            let answer = GetResultResponse { status: answer.status, result: answer.result.clone() };
            all.sent(all.server.send_result(request, answer));
        });
    }

    fn result(self: &Arc<Self>, request: RmwRequestId, id: GoalId) {
        let answer = {
            let mut goals = self.goals();
            match goals.get_mut(&id) {
                None => GetResultResponse { status: Status::Unknown, result: R::default() },
                Some(Goal { status, result: Some(result), .. }) => {
                    GetResultResponse { status: *status, result: result.clone() }
                }
                Some(goal) => {
                    goal.waits.push(request);
                    return;
                }
            }
        };
        self.tell_result(request, answer);
    }

    fn cancel(self: &Arc<Self>, request: RmwRequestId, asked: &CancelGoalRequest) {
        let response = match info(asked) {
            Some(info) => self.cancelled(&info),
            None => CancelGoalResponse { return_code: Cancel::Rejected, goals_canceling: Vec::new() },
        };
        self.answer(request, move |all| {
            all.sent(all.server.send_cancel_response(request, response.clone()));
        });
        self.tell_statuses();
    }

    fn cancelled(&self, asked: &GoalInfo) -> CancelGoalResponse {
        let mut goals = self.goals();
        let is_all = asked.goal_id == GoalId::ZERO && asked.stamp == Time::ZERO;
        let mut goals_canceling = Vec::new();
        for (id, goal) in goals.iter_mut().filter(|(_, goal)| goal.ended.is_none()) {
            let is_before = asked.stamp != Time::ZERO && goal.accepted <= asked.stamp;
            if is_all || is_before || *id == asked.goal_id {
                goal.status = Status::Canceling;
                goal.cancel.send_replace(true);
                goals_canceling.push(GoalInfo { goal_id: *id, stamp: goal.accepted });
            }
        }
        let return_code = match goals.get(&asked.goal_id) {
            _ if !goals_canceling.is_empty() => Cancel::None,
            Some(_) => Cancel::GoalTerminated,
            None if asked.goal_id == GoalId::ZERO => Cancel::Rejected,
            None => Cancel::UnknownGoal,
        };
        CancelGoalResponse { return_code, goals_canceling }
    }

    fn tell_statuses(&self) {
        let of = |(id, goal): (&GoalId, &Goal<R>)| GoalStatus {
            goal_info: GoalInfo { goal_id: *id, stamp: goal.accepted },
            status: goal.status,
        };
        let status_list = self.goals().iter().map(of).collect();
        self.sent(self.server.send_goal_statuses(GoalStatusArray { status_list }));
    }

    /// Sends an answer, and once more where whoever asks was not known yet.
    fn answer(self: &Arc<Self>, request: RmwRequestId, send: impl Fn(&Self) + Send + 'static) {
        send(self);
        let all = Arc::clone(self);
        self.presence.sent(&request, move || send(&all));
    }

    fn sent<E: std::fmt::Debug>(&self, sent: Result<(), E>) {
        if let Err(error) = sent {
            say(&format!("{}: an answer cannot be sent: {error:?}", self.name));
        }
    }
}

/// What goals a request to cancel means. The library keeps the field to itself, though it is what goes over the wire.
fn info(asked: &CancelGoalRequest) -> Option<GoalInfo> {
    let asked = serde_json::to_value(asked).ok()?;
    serde_json::from_value(asked.get("goal_info")?.clone()).ok()
}

/// Where a goal says how it goes on.
pub struct Feedback<G: Message + Clone, R: Message + Clone, F: Message> {
    all: Arc<Actions<G, R, F>>,
    id: GoalId,
}

impl<G, R, F> Feedback<G, R, F>
where
    G: Message + Clone + Send + 'static,
    R: Message + Clone + Default + Send + 'static,
    F: Message + std::fmt::Debug + Send + 'static,
    ActionServer<G, R, F>: Send + Sync,
{
    pub fn say(&self, feedback: F) {
        self.all.sent(self.all.server.send_feedback(self.id, feedback));
    }
}
