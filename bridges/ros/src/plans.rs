//! Plans that are asked for once: `GetPlan`, `ComputePathToPose`, `ComputeRoute`.

use std::sync::Arc;
use std::time::Instant;

use crate::actions::Ended;
use crate::failure::{Failure, Kind};
use crate::msgs::{GetPlanRequest, Header, Path, RouteGoal, RouteResult, Time, ToPoseGoal, ToPoseResult};
use crate::path;
use crate::planner::{Planner, Question};
use adit_site::say;

/// `GetPlan`, which has no field for what is wrong: then the plan has no poses, and the log says why.
pub async fn get_plan(planner: &Planner, request: &GetPlanRequest) -> Path {
    let planned = async {
        let tolerance = f64::from(request.tolerance);
        if !(tolerance.is_finite() && tolerance >= 0.0) {
            let words = format!("the tolerance is {tolerance}; expected metres");
            return Err(Failure::new(Kind::Unknown, words));
        }
        let mut question = planner.question(Some(&request.start), &request.goal)?;
        question.tolerance = tolerance;
        let route = planner.plan(&question).await?;
        let path = path::path(&route, &question.goal, planner.frames.map());
        planner.goes(Some(Arc::new(route)));
        Ok(path)
    };
    planned.await.unwrap_or_else(|failure| {
        say(&format!("get_plan: {}", failure.words));
        Path { header: Header::now(planner.frames.map()), poses: Vec::new() }
    })
}

/// `ComputePathToPose`.
pub async fn to_pose(planner: Arc<Planner>, goal: ToPoseGoal) -> Ended<ToPoseResult> {
    let began = Instant::now();
    let planned = async {
        let mut question = planner.question(goal.use_start.then_some(&goal.start), &goal.goal)?;
        question.robot = planner.planner(&goal.planner_id);
        let route = planner.plan(&question).await?;
        let path = path::path(&route, &question.goal, planner.frames.map());
        planner.goes(Some(Arc::new(route)));
        Ok::<Path, Failure>(path)
    };
    let planned = planned.await;
    let planning_time: Time = began.elapsed().into();
    match planned {
        Ok(path) => Ok(ToPoseResult { path, planning_time, ..ToPoseResult::default() }),
        Err(failure) => {
            say(&format!("compute_path_to_pose: {}", failure.words));
            let (error_code, error_msg) = (failure.kind.to_pose(), failure.words);
            Err(ToPoseResult { planning_time, error_code, error_msg, ..ToPoseResult::default() })
        }
    }
}

/// The question of a goal of the route server.
pub fn question(planner: &Planner, goal: &RouteGoal) -> Result<Question, Failure> {
    if !goal.use_poses {
        let words = format!(
            "the site's rooms have no lasting numbers, so {} and {} are no nodes; ask by poses (`use_poses`)",
            goal.start_id, goal.goal_id
        );
        return Err(Failure::new(Kind::NoNodes, words));
    }
    planner.question(goal.use_start.then_some(&goal.start), &goal.goal)
}

/// `ComputeRoute`.
pub async fn route(planner: Arc<Planner>, goal: RouteGoal) -> Ended<RouteResult> {
    let began = Instant::now();
    let planned = async {
        let question = question(&planner, &goal)?;
        let route = planner.plan(&question).await?;
        Ok::<_, Failure>((question, route))
    };
    match planned.await {
        Ok((question, route)) => {
            let frame = planner.frames.map();
            let path = path::path(&route, &question.goal, frame);
            let result = RouteResult {
                planning_time: began.elapsed().into(),
                path,
                route: path::route(&route, frame),
                ..RouteResult::default()
            };
            planner.goes(Some(Arc::new(route)));
            Ok(result)
        }
        Err(failure) => {
            say(&format!("compute_route: {}", failure.words));
            let (error_code, error_msg) = (failure.kind.of_route(), failure.words);
            Err(RouteResult {
                planning_time: began.elapsed().into(),
                error_code,
                error_msg,
                ..RouteResult::default()
            })
        }
    }
}
