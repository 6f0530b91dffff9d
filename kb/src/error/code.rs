//! All that can be wrong, by stable codes. HTTP status and exit status follow from the code.

use std::borrow::Cow;
use std::fmt;

use adit_db::postgres::Failure;
use axum::http::StatusCode;
use serde::{Serialize, Serializer};
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::openapi::{RefOr, schema::SchemaType};
use utoipa::{PartialSchema, ToSchema};

/// The codes with the names that users and programs see, and the HTTP status of each.
macro_rules! codes {
    ($(#[doc = $meaning:literal] $code:ident = $name:literal, $status:ident;)*) => {
        /// What is wrong. The comment of each code stands in the list that users read (`manual/src/codes.md`).
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Code {
            /// Of a rule file or a test of rules.
            Rule(adit_engine::Code),
            /// Of a map, a table of robots or a world.
            Map(adit_planners::read::Code),
            $(#[doc = $meaning] $code,)*
        }

        impl Code {
            const OWN: &[Self] = &[$(Self::$code,)*];

            const fn entry(self) -> (&'static str, StatusCode, &'static str) {
                match self {
                    Self::Rule(code) => (code.as_str(), StatusCode::UNPROCESSABLE_ENTITY, code.meaning()),
                    Self::Map(code) => (code.as_str(), StatusCode::UNPROCESSABLE_ENTITY, code.meaning()),
                    $(Self::$code => ($name, StatusCode::$status, $meaning),)*
                }
            }
        }
    };
}

codes! {
    /// The service is called by a name that it does not know; `--host NAME` makes it known.
    AuthHost = "auth/host", FORBIDDEN;
    /// A page from elsewhere calls; only the service's own page may.
    AuthOrigin = "auth/origin", FORBIDDEN;
    /// The token does not allow this; `adit token` gives roles.
    AuthRole = "auth/role", FORBIDDEN;
    /// The site asks for a token, and none was sent: `Authorization: Bearer TOKEN`.
    AuthTokenMissing = "auth/token-missing", UNAUTHORIZED;
    /// Nobody holds this token (any more).
    AuthTokenUnknown = "auth/token-unknown", UNAUTHORIZED;

    /// The database cannot be opened, read or written: missing, damaged, of another version, on a full disk.
    Database = "database", INTERNAL_SERVER_ERROR;
    /// The database is another site's, whose tables and history this site would be filled into.
    DatabaseAnothers = "database/anothers", CONFLICT;
    /// Another program holds the database; try again when it is done.
    DatabaseLocked = "database/locked", SERVICE_UNAVAILABLE;
    /// The database does not take a value, or has no such table, column or row.
    DatabaseRefused = "database/refused", BAD_REQUEST;
    /// The database was removed or replaced while it was served; start the service again.
    DatabaseReplaced = "database/replaced", INTERNAL_SERVER_ERROR;
    /// Another service serves this database already; one is enough, and two would keep each other from editing.
    DatabaseServed = "database/served", CONFLICT;

    /// The address at which a body is to be answered cannot be listened at.
    BodyListen = "body/listen", BAD_REQUEST;
    /// An answer of a body is waited for longer than not at all, and no longer than an hour.
    BodyTimeout = "body/timeout", BAD_REQUEST;
    /// The body cannot be started, or does not answer at its address.
    BodyUnheard = "body/unheard", BAD_REQUEST;

    /// The tables of a map that is not cut into rooms make no map.
    CourseTable = "course/table", BAD_REQUEST;
    /// What is asked needs a map that is cut into rooms.
    CourseUnfit = "course/unfit", BAD_REQUEST;

    /// A picture is written as .svg or .png.
    DrawFormat = "draw/format", BAD_REQUEST;
    /// There is no route to draw between these ends.
    DrawNoRoute = "draw/no-route", BAD_REQUEST;
    /// The picture cannot be made into pixels.
    DrawPng = "draw/png", BAD_REQUEST;
    /// There is no such layer of a picture.
    DrawUnknownLayer = "draw/unknown-layer", NOT_FOUND;
    /// No state of this name has rooms.
    DrawUnknownState = "draw/unknown-state", NOT_FOUND;

    /// The cell or row is another by now than the editor saw; look at it, then edit again.
    EditConflict = "edit/conflict", CONFLICT;
    /// The table follows from others and cannot be edited; edit what it follows from.
    EditDerived = "edit/derived", BAD_REQUEST;
    /// The key does not have the parts that the table's key has.
    EditKey = "edit/key", BAD_REQUEST;
    /// The column holds numbers.
    EditNotANumber = "edit/not-a-number", BAD_REQUEST;
    /// The file says what the table holds already.
    EditNoDifference = "edit/no-difference", CONFLICT;
    /// No edit is left to take back.
    EditNothingToUndo = "edit/nothing-to-undo", NOT_FOUND;
    /// The table does not take this value or row.
    EditRefused = "edit/refused", BAD_REQUEST;
    /// The table has no such column.
    EditUnknownColumn = "edit/unknown-column", NOT_FOUND;
    /// There is no such table that may be edited.
    EditUnknownTable = "edit/unknown-table", NOT_FOUND;
    /// The edit is not said as edits are: a column is missing, given twice, or is not `column=value`.
    EditUsage = "edit/usage", BAD_REQUEST;

    /// What an editor says is no message of the Language Server Protocol.
    EditorLost = "editor/lost", BAD_REQUEST;

    /// The table of an experiment cannot be written.
    ExperimentCsv = "experiment/csv", BAD_REQUEST;
    /// An experiment needs a scenario (.json).
    ExperimentFormat = "experiment/format", BAD_REQUEST;
    /// The rules failed while the experiment asked them.
    ExperimentRules = "experiment/rules", BAD_REQUEST;

    /// The file to export to is neither .yaml, .geojson nor .lif.json.
    ExportFormat = "export/format", BAD_REQUEST;
    /// A route graph of Nav2 numbers at most 65,536 nodes and as many edges.
    ExportTooMany = "export/too-many", BAD_REQUEST;

    /// A class cannot be told to the rules.
    FactsClass = "facts/class", BAD_REQUEST;
    /// A property of a class is missing or holds something else than its column should.
    FactsProperty = "facts/property", BAD_REQUEST;

    /// What is to be written would take the place of a file of which the site is made.
    FileOwn = "file/own", BAD_REQUEST;
    /// A file cannot be read or written.
    FileUnreadable = "file/unreadable", INTERNAL_SERVER_ERROR;

    /// The rules do not take a value that was tried to see how firm a route is.
    FirmRefused = "firm/refused", BAD_REQUEST;

    /// A CSV of traversals has a column that it should not have, or lacks one.
    FitColumn = "fit/column", BAD_REQUEST;
    /// A traversal cannot be, or there is none; none of those that came with it was added.
    FitRow = "fit/row", BAD_REQUEST;
    /// Nothing is measured in this measure.
    FitUnknownMeasure = "fit/unknown-measure", NOT_FOUND;
    /// There is no such state.
    FitUnknownState = "fit/unknown-state", NOT_FOUND;
    /// Several measures were taken; say which one is meant.
    FitWhichMeasure = "fit/which-measure", BAD_REQUEST;

    /// Nobody of this name follows a route (any more); open the stream anew.
    FollowUnknown = "follow/unknown", NOT_FOUND;

    /// The hours of a named door or area cannot be read: days like `mon-fri`, times like `08:00`.
    HoursUnreadable = "hours/unreadable", UNPROCESSABLE_ENTITY;

    /// What is laid over a map has more corners than rooms can be cut along at each edit.
    LaidCorners = "laid/corners", BAD_REQUEST;
    /// Something of this name was laid over the map already.
    LaidTaken = "laid/taken", CONFLICT;
    /// Nothing of this name was laid over the map.
    LaidUnknown = "laid/unknown", NOT_FOUND;
    /// A row of the table `laid` cannot be read.
    LaidUnreadable = "laid/unreadable", BAD_REQUEST;
    /// What is laid over a map is an area or a door, or an obstacle, a place or a bridge, which are of no kind; its corners are pairs of numbers, of a place one, of a door two; a bridge has a height and nothing else.
    LaidUsage = "laid/usage", BAD_REQUEST;

    /// A layer is written as .geojson or .json.
    LayerFile = "layer/file", BAD_REQUEST;
    /// The site has no layer of this name.
    LayerUnknown = "layer/unknown", NOT_FOUND;
    /// A row of a layer has a shape that cannot be read.
    LayerUnreadable = "layer/unreadable", BAD_REQUEST;

    /// The tables were edited meanwhile; try again.
    LiveStale = "live/stale", INTERNAL_SERVER_ERROR;

    /// No mission of this number is kept.
    MissionUnknown = "mission/unknown", NOT_FOUND;

    /// An answer cannot be written as JSON.
    OutputJson = "output/json", BAD_REQUEST;

    /// The cell cannot be planned in as it is.
    PlanCell = "plan/cell", BAD_REQUEST;
    /// The configuration has the wrong number of joints, or a joint that cannot be so.
    PlanConfiguration = "plan/configuration", BAD_REQUEST;
    /// Experience that was kept cannot be read; forget it.
    PlanDamagedExperience = "plan/damaged-experience", BAD_REQUEST;
    /// The cell has experience already, so another's cannot be copied to it.
    PlanHasExperience = "plan/has-experience", BAD_REQUEST;
    /// Tasks are for maps with `[cell]`.
    PlanNoCell = "plan/no-cell", BAD_REQUEST;
    /// There is no experience of this cell.
    PlanNoExperience = "plan/no-experience", BAD_REQUEST;
    /// The cell names no goal that could be drawn.
    PlanNoGoals = "plan/no-goals", BAD_REQUEST;
    /// There is no rule base of this name, and no such folder.
    PlanNoRules = "plan/no-rules", BAD_REQUEST;
    /// The file is no map without rooms: it needs `[assembly]`, `[corridor]`, `[floor_plan]` or `[cell]`.
    PlanNoTask = "plan/no-task", BAD_REQUEST;
    /// Experience is of another robot; keep it in another database or under another name.
    PlanOtherRobot = "plan/other-robot", BAD_REQUEST;
    /// The rules failed while the planner asked them, or gave nothing that it can use.
    PlanRules = "plan/rules", BAD_REQUEST;
    /// The file has no such scenario, or several, or is none.
    PlanScenario = "plan/scenario", BAD_REQUEST;
    /// Another program keeps experience of this cell in this database; run one at a time.
    PlanTwoPrograms = "plan/two-programs", BAD_REQUEST;
    /// The map's file has several of these tables; it may have one.
    PlanTwoTasks = "plan/two-tasks", BAD_REQUEST;
    /// The cell has no such goal.
    PlanUnknownGoal = "plan/unknown-goal", NOT_FOUND;
    /// The floor plan has no such place.
    PlanUnknownPlace = "plan/unknown-place", NOT_FOUND;

    /// A planner could not give its facts.
    PlannerFailed = "planner/failed", UNPROCESSABLE_ENTITY;

    /// A service's copy of a site in PostgreSQL does not take what another one wrote; it is made anew.
    PostgresCopy = "postgres/copy", SERVICE_UNAVAILABLE;
    /// The right to edit went to another service; nothing of the edit was kept.
    PostgresFenced = "postgres/fenced", SERVICE_UNAVAILABLE;
    /// The site's files cannot be kept in PostgreSQL, or the folder's are not those that are.
    PostgresFiles = "postgres/files", BAD_REQUEST;
    /// Another service edits the site; try again.
    PostgresHeld = "postgres/held", SERVICE_UNAVAILABLE;
    /// The edit is made and kept in PostgreSQL, and this service does not show it yet: do not make it again.
    PostgresKept = "postgres/kept", SERVICE_UNAVAILABLE;
    /// PostgreSQL does not let this user in: password, user or database are wrong.
    PostgresLetIn = "postgres/let-in", INTERNAL_SERVER_ERROR;
    /// This user of PostgreSQL has no right to do that.
    PostgresRights = "postgres/rights", INTERNAL_SERVER_ERROR;
    /// PostgreSQL has a site of this name already.
    PostgresSiteExists = "postgres/site-exists", CONFLICT;
    /// PostgreSQL refused a statement.
    PostgresSql = "postgres/sql", INTERNAL_SERVER_ERROR;
    /// The connection to PostgreSQL cannot be made as safe as `sslmode` asks: no TLS there, or a certificate that does not hold.
    PostgresTls = "postgres/tls", INTERNAL_SERVER_ERROR;
    /// The connection broke while an edit was kept: look whether it was made before you make it again.
    PostgresUnknownOutcome = "postgres/unknown-outcome", SERVICE_UNAVAILABLE;
    /// PostgreSQL has no site of this name.
    PostgresUnknownSite = "postgres/unknown-site", NOT_FOUND;
    /// PostgreSQL cannot be reached; edits are made again when it can.
    PostgresUnreachable = "postgres/unreachable", SERVICE_UNAVAILABLE;
    /// An upgrade in PostgreSQL has to wait: what an earlier one kept is there, or a program holds the tables.
    PostgresUpgrade = "postgres/upgrade", CONFLICT;
    /// It is no URL of a PostgreSQL database.
    PostgresUrl = "postgres/url", BAD_REQUEST;
    /// The sites in PostgreSQL are of another version of the program.
    PostgresVersion = "postgres/version", INTERNAL_SERVER_ERROR;

    /// The verb is a program of its own, and does not lie beside `adit`.
    ProgramMissing = "program/missing", NOT_FOUND;

    /// The table of robots has no state.
    RobotsEmpty = "robots/empty", BAD_REQUEST;

    /// A route cannot be written as JSON.
    RouteJson = "route/json", BAD_REQUEST;
    /// A point is outside of the map.
    RouteOutside = "route/outside", BAD_REQUEST;
    /// The moment of an errand is over.
    RoutePast = "route/past", BAD_REQUEST;
    /// There is no route, and why cannot be found out.
    RouteReason = "route/reason", BAD_REQUEST;
    /// A point is inside an obstacle.
    RouteSolid = "route/solid", BAD_REQUEST;
    /// Where a robot is said to be that follows a route, no state of it fits.
    RouteUnfit = "route/unfit", BAD_REQUEST;
    /// The site has no robot yet; build it.
    RouteUnbuilt = "route/unbuilt", BAD_REQUEST;
    /// The name is no place, no space, no room and no point.
    RouteUnknown = "route/unknown", NOT_FOUND;
    /// The goal is no place, no space, no room and no point.
    RouteUnknownGoal = "route/unknown-goal", NOT_FOUND;
    /// There is no such robot.
    RouteUnknownRobot = "route/unknown-robot", NOT_FOUND;
    /// The start is no place, no space, no room and no point.
    RouteUnknownStart = "route/unknown-start", NOT_FOUND;
    /// No room is one of this state of the robot.
    RouteUnknownState = "route/unknown-state", NOT_FOUND;
    /// The site has several robots; say which one is meant.
    RouteWhichRobot = "route/which-robot", BAD_REQUEST;
    /// How far a start or goal may be moved is a number of metres from 0 to 100.
    RouteWithin = "route/within", BAD_REQUEST;

    /// Rules must give hardness as numbers.
    RuleHardness = "rule/hardness", UNPROCESSABLE_ENTITY;
    /// A row of a table that a rule can never choose, since another comes before it wherever it fits.
    RuleNeverChosen = "rule/never-chosen", UNPROCESSABLE_ENTITY;
    /// A rule that reacts and cannot do what it says, or stands in a world, where reactions are not carried out.
    RuleNotCarriedOut = "rule/not-carried-out", UNPROCESSABLE_ENTITY;
    /// A file or folder that looks like rules and does not count.
    RuleNotRead = "rule/not-read", UNPROCESSABLE_ENTITY;
    /// A rule beneath was changed since the one that replaces it was written.
    RuleChangedBeneath = "rule/changed-beneath", UNPROCESSABLE_ENTITY;
    /// A rule asks for a text that no object has, though one has nearly the same.
    RuleUnknownText = "rule/unknown-text", UNPROCESSABLE_ENTITY;
    /// A property that a rule sets and nothing reads; often a slip of the pen.
    RuleUnreadProperty = "rule/unread-property", UNPROCESSABLE_ENTITY;

    /// A planner changes, by what it gives, what it is made from, without end.
    RulesCircle = "rules/circle", UNPROCESSABLE_ENTITY;
    /// The rule file is another by now than was read; read it again.
    RulesConflict = "rules/conflict", CONFLICT;
    /// A planner needs what no rule, table or other planner gives.
    RulesMissing = "rules/missing", UNPROCESSABLE_ENTITY;
    /// A rule file is called NAME.rhai, and a test of rules tests/NAME.toml.
    RulesName = "rules/name", BAD_REQUEST;
    /// The folder has no rule file.
    RulesNone = "rules/none", UNPROCESSABLE_ENTITY;
    /// Tests of the rules fail, so nothing was saved.
    RulesTests = "rules/tests", UNPROCESSABLE_ENTITY;
    /// The rule file is longer than is accepted.
    RulesTooLong = "rules/too-long", BAD_REQUEST;
    /// No rule of this name counts.
    RulesUnknown = "rules/unknown", NOT_FOUND;
    /// There is no such rule file.
    RulesUnknownFile = "rules/unknown-file", NOT_FOUND;

    /// The service cannot listen at this address.
    ServeAddress = "serve/address", BAD_REQUEST;
    /// The service ended while an edit was at work, of which nothing is kept.
    ServeBrokenOff = "serve/broken-off", BAD_REQUEST;
    /// The service ended by a defect of its own.
    ServeEnded = "serve/ended", BAD_REQUEST;
    /// The service can be reached from elsewhere and has no tokens; make one.
    ServeNoTokens = "serve/no-tokens", BAD_REQUEST;
    /// The service cannot begin its work.
    ServeRuntime = "serve/runtime", BAD_REQUEST;
    /// A thread of the service cannot be begun.
    ServeThread = "serve/thread", BAD_REQUEST;

    /// The body is JSON, but not what this route takes.
    ServiceBody = "service/body", UNPROCESSABLE_ENTITY;
    /// More is asked at once than can be answered; try again in a moment.
    ServiceBusy = "service/busy", SERVICE_UNAVAILABLE;
    /// The body is not said to be JSON: `Content-Type: application/json`.
    ServiceContentType = "service/content-type", UNSUPPORTED_MEDIA_TYPE;
    /// The service ends, and nothing was changed.
    ServiceEnding = "service/ending", SERVICE_UNAVAILABLE;
    /// A defect of the service; its log says more.
    ServiceInternal = "service/internal", INTERNAL_SERVER_ERROR;
    /// The answer took too long, and nothing was changed.
    ServiceLate = "service/late", SERVICE_UNAVAILABLE;
    /// The address is there, but is not asked in this way.
    ServiceMethod = "service/method", METHOD_NOT_ALLOWED;
    /// Edits cannot be saved at present; routes are answered all the same.
    ServiceNotReady = "service/not-ready", SERVICE_UNAVAILABLE;
    /// A part of the address cannot be read.
    ServicePath = "service/path", BAD_REQUEST;
    /// What stands behind the question mark is missing, unknown or cannot be read.
    ServiceQuestion = "service/question", BAD_REQUEST;
    /// The request was refused before any route looked at it.
    ServiceRefused = "service/refused", BAD_REQUEST;
    /// One caller asks for more at once than its share; try again in a moment.
    ServiceShare = "service/share", TOO_MANY_REQUESTS;
    /// The body is no JSON, or no text.
    ServiceSyntax = "service/syntax", BAD_REQUEST;
    /// The body is longer than is accepted.
    ServiceTooLarge = "service/too-large", PAYLOAD_TOO_LARGE;
    /// More edits are previewed at once than is accepted.
    ServiceTooMany = "service/too-many", BAD_REQUEST;
    /// Nothing is at this address; `/api/openapi.json` lists what is there.
    ServiceUnknown = "service/unknown", NOT_FOUND;

    /// The mission drives by hand, and lacks what that needs: --learned and --db.
    SimulateDrive = "simulate/drive", BAD_REQUEST;
    /// A film is an .svg.
    SimulateFilm = "simulate/film", BAD_REQUEST;
    /// A heading is given in degrees from -360 to 360.
    SimulateHeading = "simulate/heading", BAD_REQUEST;
    /// The robot cannot be where it should begin, or cannot drive in this building.
    SimulateImpossible = "simulate/impossible", BAD_REQUEST;
    /// What was learned stands in a database: --learned goes with --db.
    SimulateLearned = "simulate/learned", BAD_REQUEST;
    /// The distance to drive is none, or is too far.
    SimulateMetres = "simulate/metres", BAD_REQUEST;
    /// The world has no `[floor_plan]`.
    SimulateNoFloorPlan = "simulate/no-floor-plan", BAD_REQUEST;
    /// There is no mission of this number.
    SimulateNoMission = "simulate/no-mission", BAD_REQUEST;
    /// The plan has no room for missions, which go over some metres.
    SimulateNoRoom = "simulate/no-room", BAD_REQUEST;
    /// Nothing was learned of this world yet; learn it first with --learn.
    SimulateNotLearned = "simulate/not-learned", BAD_REQUEST;
    /// The rules failed while the robot asked them, or gave nothing that it can use.
    SimulateRules = "simulate/rules", BAD_REQUEST;
    /// A film plays faster than not at all.
    SimulateSpeed = "simulate/speed", BAD_REQUEST;

    /// Something is where the site or a part of it would be written.
    SiteExists = "site/exists", UNPROCESSABLE_ENTITY;
    /// The site has no map, and so no rooms, robots and routes.
    SiteNoMap = "site/no-map", UNPROCESSABLE_ENTITY;
    /// The map of a site is its file alone, which keeps no edits; `adit new --map` makes a site of it.
    SiteMapAlone = "site/map-alone", UNPROCESSABLE_ENTITY;
    /// The folder is no site; `adit new` starts one.
    SiteMissing = "site/missing", UNPROCESSABLE_ENTITY;
    /// A place is named like a point `x,y`; give it another name.
    SitePlaceNamedLikeAPoint = "site/place-named-like-a-point", UNPROCESSABLE_ENTITY;
    /// A place is named like a room; give it a longer name.
    SitePlaceNamedLikeARoom = "site/place-named-like-a-room", UNPROCESSABLE_ENTITY;
    /// This mode of rooms is for one robot, and the site has several.
    SiteRobots = "site/robots", UNPROCESSABLE_ENTITY;
    /// `starts` names one start twice.
    SiteStarts = "site/starts", UNPROCESSABLE_ENTITY;
    /// There is no robot of this name to begin with.
    SiteUnknownRobot = "site/unknown-robot", UNPROCESSABLE_ENTITY;
    /// `starts` names what is no place or room.
    SiteUnknownStart = "site/unknown-start", UNPROCESSABLE_ENTITY;

    /// The query is no single statement that reads, is wrong, or took more than it may.
    SqlRefused = "sql/refused", BAD_REQUEST;
    /// No query of this name is kept.
    SqlUnknownQuery = "sql/unknown-query", NOT_FOUND;

    /// A file of a table does not read as one.
    TableFile = "table/file", UNPROCESSABLE_ENTITY;
    /// A column of the site's own table holds numbers and texts; a rule needs one or the other.
    TableMixed = "table/mixed", BAD_REQUEST;
    /// A table of one's own has the name of a class that a planner gives, or of a table that a newer version or a plan makes; rename it.
    TableTaken = "table/taken", BAD_REQUEST;
    /// A cell names a row of another table, and there is no such row.
    TableUnknownRow = "table/unknown-row", UNPROCESSABLE_ENTITY;

    /// A change of shape cannot be found again after a build; tell about a room or a state.
    TellChange = "tell/change", BAD_REQUEST;
    /// The property says which object it is, and cannot be told.
    TellKey = "tell/key", BAD_REQUEST;
    /// A fact no longer finds what it is about; tell it again, or take it back.
    TellLost = "tell/lost", BAD_REQUEST;
    /// No door is near the point.
    TellNoDoor = "tell/no-door", BAD_REQUEST;
    /// Objects of the class are numbered anew by each build, so nothing can be told about one.
    TellNumbered = "tell/numbered", BAD_REQUEST;
    /// The fact ends before now.
    TellPast = "tell/past", BAD_REQUEST;
    /// The rules do not take the fact.
    TellRefused = "tell/refused", BAD_REQUEST;
    /// The property holds values of another type.
    TellType = "tell/type", BAD_REQUEST;
    /// There is no such class.
    TellUnknownClass = "tell/unknown-class", NOT_FOUND;
    /// No fact of this number is told.
    TellUnknownFact = "tell/unknown-fact", NOT_FOUND;
    /// The class has no such object, or several.
    TellUnknownObject = "tell/unknown-object", NOT_FOUND;
    /// No rule reads this property; `--new` tells it all the same.
    TellUnknownProperty = "tell/unknown-property", NOT_FOUND;
    /// A row of the table `told` is incomplete.
    TellUnreadable = "tell/unreadable", BAD_REQUEST;
    /// A fact is CLASS OBJECT PROPERTY VALUE, and has one end at most.
    TellUsage = "tell/usage", BAD_REQUEST;

    /// The text is no time: `2026-11-21T18:00`, `18:00`, `2h`.
    TimeUnreadable = "time/unreadable", BAD_REQUEST;

    /// There is a token of this name already.
    TokensExists = "tokens/exists", BAD_REQUEST;
    /// A token cannot be called so.
    TokensName = "tokens/name", BAD_REQUEST;
    /// The file of tokens holds none, so nobody is let in.
    TokensNone = "tokens/none", BAD_REQUEST;
    /// The system gives no random numbers to make a token of.
    TokensRandom = "tokens/random", BAD_REQUEST;
    /// There is no token of this name.
    TokensUnknown = "tokens/unknown", NOT_FOUND;
    /// The file of tokens cannot be read.
    TokensUnreadable = "tokens/unreadable", BAD_REQUEST;
    /// The file of tokens cannot be written.
    TokensUnwritable = "tokens/unwritable", BAD_REQUEST;

    /// The tuning is on, or off, already.
    TuningAlready = "tuning/already", BAD_REQUEST;
    /// Two tunings that are on set one cell to different values; switch one of them off.
    TuningConflict = "tuning/conflict", BAD_REQUEST;
    /// A tuning cannot be called so.
    TuningName = "tuning/name", BAD_REQUEST;
    /// The tuning does not set this cell.
    TuningNoSuchCell = "tuning/no-such-cell", BAD_REQUEST;
    /// There are more routes between places than are compared; name fewer `starts`.
    TuningTooMany = "tuning/too-many", BAD_REQUEST;
    /// The tuning sets a cell to what its column does not hold.
    TuningType = "tuning/type", BAD_REQUEST;
    /// There is no such tuning.
    TuningUnknown = "tuning/unknown", NOT_FOUND;
    /// The words after `adit tuning` mean nothing; `adit tuning --help` shows what they may be.
    TuningUsage = "tuning/usage", BAD_REQUEST;

    /// Nobody said where a robot of this name is.
    WhereaboutsUnknown = "whereabouts/unknown", NOT_FOUND;

    /// The database keeps no mission of this number.
    WhyNoMission = "why/no-mission", BAD_REQUEST;
    /// Options for missions are given, and the file is no database of missions.
    WhyNoMissions = "why/no-missions", BAD_REQUEST;
    /// The mission had decided nothing by then.
    WhyNoStop = "why/no-stop", BAD_REQUEST;
    /// The property is not concluded of this object.
    WhyNotConcluded = "why/not-concluded", BAD_REQUEST;
    /// The rules failed when they were asked again.
    WhyRules = "why/rules", BAD_REQUEST;
    /// A route leads through rooms and doors, and this is neither.
    WhyThrough = "why/through", BAD_REQUEST;
    /// A time of a mission is in seconds.
    WhyTime = "why/time", BAD_REQUEST;
    /// Nothing of this name is known.
    WhyUnknown = "why/unknown", NOT_FOUND;
    /// The database has missions of several worlds; say which one is meant.
    WhyWhichWorld = "why/which-world", BAD_REQUEST;
}

impl Code {
    /// Every code, those of rules and maps last.
    pub fn all() -> impl Iterator<Item = Self> {
        let rules = adit_engine::Code::ALL.iter().copied().map(Self::Rule);
        let maps = adit_planners::read::Code::ALL.iter().copied().map(Self::Map);
        Self::OWN.iter().copied().chain(rules).chain(maps)
    }

    pub const fn as_str(self) -> &'static str {
        self.entry().0
    }

    /// The status of an answer over HTTP.
    pub const fn http(self) -> StatusCode {
        self.entry().1
    }

    /// The exit status of the command line: 1 where there is no route or a check failed, 2 for unusable input.
    pub const fn exit(self) -> u8 {
        match self {
            Self::DrawNoRoute | Self::Rule(adit_engine::Code::TestFailed) => 1,
            _ => 2,
        }
    }

    /// What it means, and where that is not plain what to do about it, in one sentence.
    pub fn meaning(self) -> &'static str {
        self.entry().2.trim_start()
    }
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl Serialize for Code {
    fn serialize<S: Serializer>(&self, out: S) -> Result<S::Ok, S::Error> {
        out.serialize_str(self.as_str())
    }
}

impl PartialSchema for Code {
    fn schema() -> RefOr<Schema> {
        let names = Self::all().map(Self::as_str);
        ObjectBuilder::new().schema_type(SchemaType::new(Type::String)).enum_values(Some(names)).into()
    }
}

impl ToSchema for Code {
    fn name() -> Cow<'static, str> {
        "Code".into()
    }
}

impl From<&adit_db::Error> for Code {
    fn from(error: &adit_db::Error) -> Self {
        use adit_db::Error;
        match error {
            Error::Refused { .. }
            | Error::UnknownTable(_)
            | Error::UnknownColumn { .. }
            | Error::UnknownKey { .. }
            | Error::AmbiguousKey { .. }
            | Error::NotEditable(_)
            | Error::NotANumber { .. } => Self::DatabaseRefused,
            Error::Conflict { .. } => Self::EditConflict,
            Error::Query(_) | Error::Deadline(_) => Self::SqlRefused,
            Error::Locked(_) => Self::DatabaseLocked,
            Error::Postgres(failure) => Self::from(failure),
            Error::Taken { .. } => Self::TableTaken,
            _ => Self::Database,
        }
    }
}

impl From<&Failure> for Code {
    fn from(failure: &Failure) -> Self {
        match failure {
            Failure::Url(_) => Self::PostgresUrl,
            Failure::Tls { .. } => Self::PostgresTls,
            Failure::LetIn { .. } => Self::PostgresLetIn,
            Failure::Rights { .. } => Self::PostgresRights,
            Failure::NoSites(_) | Failure::UnknownSite { .. } => Self::PostgresUnknownSite,
            Failure::SiteExists { .. } => Self::PostgresSiteExists,
            Failure::InUse(_) | Failure::KeptAlready { .. } => Self::PostgresUpgrade,
            Failure::Version { .. } => Self::PostgresVersion,
            Failure::Held(_) => Self::PostgresHeld,
            Failure::Fenced(_) => Self::PostgresFenced,
            Failure::KeptThere { .. } => Self::PostgresKept,
            Failure::UnknownOutcome(_) => Self::PostgresUnknownOutcome,
            Failure::TooFarBehind(_) | Failure::Copy { .. } => Self::PostgresCopy,
            Failure::Sql(_) => Self::PostgresSql,
            _ => Self::PostgresUnreachable,
        }
    }
}
