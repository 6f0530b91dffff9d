-- What the release of schema version 21 made in PostgreSQL of two sites: pg_dump, without comments and owners.
SET statement_timeout = 0;
SET lock_timeout = 0;
SET idle_in_transaction_session_timeout = 0;
SET client_encoding = 'UTF8';
SET standard_conforming_strings = on;
SELECT pg_catalog.set_config('search_path', '', false);
SET check_function_bodies = false;
SET xmloption = content;
SET client_min_messages = warning;
SET row_security = off;
CREATE SCHEMA adit;
SET default_tablespace = '';
SET default_table_access_method = heap;
CREATE TABLE adit.course_steps (
    site text NOT NULL,
    robot text NOT NULL,
    start text NOT NULL,
    goal text NOT NULL,
    step bigint NOT NULL,
    kind text NOT NULL,
    place text NOT NULL,
    state text,
    action text,
    hardness double precision,
    cost double precision NOT NULL,
    x double precision,
    y double precision,
    z double precision,
    heading double precision,
    rule text,
    measures text
);
CREATE TABLE adit.doors (
    site text NOT NULL,
    door bigint NOT NULL,
    kind text NOT NULL,
    room1 bigint NOT NULL,
    room2 bigint NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL,
    width double precision NOT NULL,
    height1 double precision,
    width1 double precision,
    distance1 double precision,
    height2 double precision,
    width2 double precision,
    distance2 double precision,
    hardness double precision,
    action text,
    passable bigint,
    one_way bigint NOT NULL,
    x0 double precision NOT NULL,
    y0 double precision NOT NULL,
    x1 double precision NOT NULL,
    y1 double precision NOT NULL,
    hardness_rule bigint,
    hardness_witness bigint,
    action_rule bigint,
    action_witness bigint,
    passable_rule bigint,
    passable_witness bigint,
    measures text
);
CREATE TABLE adit.doorways (
    site text NOT NULL,
    doorway bigint NOT NULL,
    called text,
    name text,
    space1 bigint NOT NULL,
    space2 bigint NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL,
    x0 double precision NOT NULL,
    y0 double precision NOT NULL,
    x1 double precision NOT NULL,
    y1 double precision NOT NULL,
    width double precision NOT NULL,
    height double precision,
    closed bigint,
    closed_from text
);
CREATE TABLE adit.ends (
    site text NOT NULL,
    name text NOT NULL,
    node bigint NOT NULL,
    kind text NOT NULL,
    kept bigint NOT NULL
);
CREATE TABLE adit.rooms (
    site text NOT NULL,
    room bigint NOT NULL,
    name text NOT NULL,
    robot text,
    state text,
    x0 double precision NOT NULL,
    y0 double precision NOT NULL,
    x1 double precision NOT NULL,
    y1 double precision NOT NULL,
    height double precision,
    width double precision NOT NULL,
    hardness double precision,
    action text,
    hardness_rule bigint,
    hardness_witness bigint,
    action_rule bigint,
    action_witness bigint,
    passable bigint,
    passable_rule bigint,
    passable_witness bigint,
    facing double precision,
    outline text,
    radius double precision,
    space bigint,
    berth double precision,
    berth_cost double precision,
    measures text
);
CREATE TABLE adit.rules (
    site text NOT NULL,
    rule bigint NOT NULL,
    name text NOT NULL,
    version text NOT NULL,
    file text,
    line bigint
);
CREATE TABLE adit.spaces (
    site text NOT NULL,
    space bigint NOT NULL,
    called text,
    name text,
    kind text,
    area double precision NOT NULL,
    breadth double precision NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL,
    outline text NOT NULL,
    closed bigint
);
CREATE TABLE adit.starts (
    site text NOT NULL,
    name text NOT NULL,
    robot text NOT NULL,
    tree bigint NOT NULL
);
CREATE TABLE adit.tree_rows (
    site text NOT NULL,
    tree bigint NOT NULL,
    node bigint NOT NULL,
    prev bigint,
    from_room bigint,
    door bigint,
    hops bigint NOT NULL,
    reach double precision NOT NULL,
    leg double precision NOT NULL,
    x double precision,
    y double precision,
    heading bigint,
    distance double precision,
    clearance double precision,
    bend bigint NOT NULL,
    walked double precision
);
CREATE VIEW adit.kept_steps AS
 SELECT s.site,
    s.robot,
    s.name AS start,
    e.name AS goal,
    (((2 * t.hops) - 1) + p.part) AS step,
        CASE
            WHEN (p.part = 1) THEN d.kind
            ELSE 'room'::text
        END AS kind,
        CASE
            WHEN (p.part = 1) THEN (t.door)::text
            ELSE r.name
        END AS place,
        CASE
            WHEN ((p.part = 1) AND (d.kind = 'change'::text)) THEN ( SELECT n.state
               FROM adit.rooms n
              WHERE ((n.site = s.site) AND (n.room =
                    CASE d.room1
                        WHEN COALESCE(t.from_room, t.prev) THEN d.room2
                        ELSE d.room1
                    END)))
            ELSE r.state
        END AS state,
        CASE
            WHEN (p.part = 1) THEN d.action
            ELSE r.action
        END AS action,
        CASE
            WHEN (p.part = 1) THEN d.hardness
            WHEN ((p.part = 2) AND (t.door IS NOT NULL)) THEN (0.0)::double precision
            ELSE t.leg
        END AS hardness,
        CASE
            WHEN (p.part > 0) THEN (t.reach + COALESCE(d.hardness, (0.0)::double precision))
            ELSE t.reach
        END AS cost,
    COALESCE(t.x, d.x) AS x,
    COALESCE(t.y, d.y) AS y,
        CASE
            WHEN ((p.part = 2) AND (t.door IS NOT NULL)) THEN NULL::double precision
            ELSE ((t.heading)::double precision / (100.0)::double precision)
        END AS heading,
    u.name AS rule,
        CASE
            WHEN (p.part <> 1) THEN ( SELECT COALESCE(o.name, ('space '::text || o.space)) AS "coalesce"
               FROM adit.spaces o
              WHERE ((o.site = s.site) AND (o.space = r.space)))
            ELSE NULL::text
        END AS space,
        CASE
            WHEN ((p.part = 1) AND (d.kind = 'door'::text)) THEN ( SELECT COALESCE(w.name, ('doorway '::text || w.doorway)) AS "coalesce"
               FROM ((adit.rooms a
                 JOIN adit.rooms b ON (((b.site = s.site) AND (b.room = d.room2))))
                 JOIN adit.doorways w ON (((w.site = s.site) AND (w.space1 = LEAST(a.space, b.space)) AND (w.space2 = GREATEST(a.space, b.space)))))
              WHERE ((a.site = s.site) AND (a.room = d.room1) AND (a.space <> b.space))
              ORDER BY (((w.x - d.x) * (w.x - d.x)) + ((w.y - d.y) * (w.y - d.y))), w.doorway
             LIMIT 1)
            ELSE NULL::text
        END AS doorway,
    NULL::double precision AS z,
        CASE
            WHEN (p.part = 1) THEN (((d.measures)::json ->> 'seconds'::text))::double precision
            WHEN (((((r.measures)::json ->> 'seconds'::text))::double precision = (0.0)::double precision) OR ((p.part = 2) AND (t.door IS NOT NULL))) THEN ((0.0)::double precision * (((r.measures)::json ->> 'seconds'::text))::double precision)
            ELSE (t.walked * (((r.measures)::json ->> 'seconds'::text))::double precision)
        END AS seconds,
        CASE
            WHEN (p.part = 1) THEN (((d.measures)::json ->> 'joules'::text))::double precision
            WHEN (((((r.measures)::json ->> 'joules'::text))::double precision = (0.0)::double precision) OR ((p.part = 2) AND (t.door IS NOT NULL))) THEN ((0.0)::double precision * (((r.measures)::json ->> 'joules'::text))::double precision)
            ELSE (t.walked * (((r.measures)::json ->> 'joules'::text))::double precision)
        END AS joules,
    ( SELECT
                CASE
                    WHEN (count(amounts.key) > 0) THEN (json_object_agg(amounts.key, amounts.amount))::text
                    ELSE NULL::text
                END AS "case"
           FROM ( SELECT v.key,
                        CASE
                            WHEN (p.part = 1) THEN (v.value)::double precision
                            WHEN (((v.value)::double precision = (0.0)::double precision) OR ((p.part = 2) AND (t.door IS NOT NULL))) THEN (0.0)::double precision
                            ELSE (t.walked * (v.value)::double precision)
                        END AS amount
                   FROM json_each_text((
                        CASE p.part
                            WHEN 1 THEN d.measures
                            ELSE r.measures
                        END)::json) v(key, value)) amounts
          WHERE (amounts.amount IS NOT NULL)) AS measures
   FROM ((((((adit.starts s
     JOIN adit.ends e ON ((e.site = s.site)))
     CROSS JOIN LATERAL ( WITH RECURSIVE walk AS (
                 SELECT g.site,
                    g.tree,
                    g.node,
                    g.prev,
                    g.from_room,
                    g.door,
                    g.hops,
                    g.reach,
                    g.leg,
                    g.x,
                    g.y,
                    g.heading,
                    g.distance,
                    g.clearance,
                    g.bend,
                    g.walked
                   FROM adit.tree_rows g
                  WHERE ((g.site = s.site) AND (g.tree = s.tree) AND (g.node = e.node))
                UNION ALL
                 SELECT b.site,
                    b.tree,
                    b.node,
                    b.prev,
                    b.from_room,
                    b.door,
                    b.hops,
                    b.reach,
                    b.leg,
                    b.x,
                    b.y,
                    b.heading,
                    b.distance,
                    b.clearance,
                    b.bend,
                    b.walked
                   FROM (walk walk_1
                     JOIN adit.tree_rows b ON (((b.site = walk_1.site) AND (b.tree = walk_1.tree) AND (b.node = walk_1.prev))))
                )
         SELECT walk.site,
            walk.tree,
            walk.node,
            walk.prev,
            walk.from_room,
            walk.door,
            walk.hops,
            walk.reach,
            walk.leg,
            walk.x,
            walk.y,
            walk.heading,
            walk.distance,
            walk.clearance,
            walk.bend,
            walk.walked
           FROM walk) t)
     CROSS JOIN ( VALUES (0), (1), (2)) p(part))
     LEFT JOIN adit.doors d ON (((d.site = s.site) AND (d.door = t.door))))
     LEFT JOIN adit.rooms r ON (((r.site = s.site) AND (r.room =
        CASE
            WHEN ((p.part = 2) AND (e.node > 0)) THEN e.node
            ELSE COALESCE(t.from_room, t.prev)
        END))))
     LEFT JOIN adit.rules u ON (((u.site = s.site) AND (u.rule =
        CASE
            WHEN (p.part = 1) THEN d.hardness_rule
            ELSE r.action_rule
        END))))
  WHERE ((p.part >=
        CASE
            WHEN (t.door IS NULL) THEN 2
            ELSE 0
        END) AND (p.part <=
        CASE
            WHEN (t.node = e.node) THEN 2
            ELSE 1
        END))
UNION ALL
 SELECT course_steps.site,
    course_steps.robot,
    course_steps.start,
    course_steps.goal,
    course_steps.step,
    course_steps.kind,
    course_steps.place,
    course_steps.state,
    course_steps.action,
    course_steps.hardness,
    course_steps.cost,
    course_steps.x,
    course_steps.y,
    course_steps.heading,
    course_steps.rule,
    NULL::text AS space,
    NULL::text AS doorway,
    course_steps.z,
    (((course_steps.measures)::json ->> 'seconds'::text))::double precision AS seconds,
    (((course_steps.measures)::json ->> 'joules'::text))::double precision AS joules,
    course_steps.measures
   FROM adit.course_steps;
CREATE VIEW adit.action_sequence AS
 SELECT kept_steps.site,
    kept_steps.robot,
    kept_steps.start,
    kept_steps.goal,
    kept_steps.step,
    kept_steps.kind,
    kept_steps.place,
    kept_steps.state,
    kept_steps.action,
    kept_steps.hardness,
    kept_steps.cost,
    kept_steps.x,
    kept_steps.y,
    kept_steps.heading,
    kept_steps.rule,
    kept_steps.space,
    kept_steps.doorway,
    kept_steps.z,
    kept_steps.seconds,
    kept_steps.joules,
    kept_steps.measures
   FROM adit.kept_steps;
CREATE TABLE adit.active_tunings (
    site text NOT NULL,
    tuning text NOT NULL
);
CREATE TABLE adit.area_outlines (
    site text NOT NULL,
    area text NOT NULL,
    kind text,
    outline text NOT NULL,
    heading double precision
);
CREATE TABLE adit.attachments (
    site text NOT NULL,
    told bigint NOT NULL,
    key text NOT NULL
);
CREATE TABLE adit.cell_objects (
    site text NOT NULL,
    cell text NOT NULL,
    object text NOT NULL,
    number bigint NOT NULL,
    revision bigint NOT NULL,
    times_moved bigint NOT NULL,
    movable bigint NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL,
    heading_rad double precision NOT NULL,
    polygon text NOT NULL
);
CREATE TABLE adit.cells (
    site text NOT NULL,
    cell text NOT NULL,
    robot text NOT NULL,
    seed text NOT NULL,
    tasks bigint NOT NULL,
    revision bigint NOT NULL,
    next_subgoal bigint NOT NULL,
    next_edge bigint NOT NULL,
    configuration text NOT NULL,
    stands bigint,
    figures text NOT NULL,
    copied_from text,
    at text NOT NULL
);
CREATE TABLE adit.tuning_cells (
    site text NOT NULL,
    tuning text NOT NULL,
    table_name text NOT NULL,
    key text NOT NULL,
    column_name text NOT NULL,
    value text
);
CREATE VIEW adit.cells_in_force AS
 SELECT c.site,
    c.table_name,
    c.key,
    c.column_name,
    ((c.value)::json #>> '{}'::text[]) AS value,
    c.tuning
   FROM (adit.active_tunings a
     JOIN adit.tuning_cells c ON (((c.site = a.site) AND (c.tuning = a.tuning))));
CREATE TABLE adit.changes (
    site text NOT NULL,
    robot text NOT NULL,
    from_state text NOT NULL,
    to_state text NOT NULL,
    hardness double precision NOT NULL,
    seconds double precision,
    joules double precision
);
CREATE VIEW adit.changes_in_force AS
 SELECT r.site,
    r.robot,
    r.from_state,
    r.to_state,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'changes'::text) AND (c.key = ((((r.robot || '/'::text) || r.from_state) || '/'::text) || r.to_state)) AND (c.column_name = 'hardness'::text))))::double precision, r.hardness) AS hardness,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'changes'::text) AND (c.key = ((((r.robot || '/'::text) || r.from_state) || '/'::text) || r.to_state)) AND (c.column_name = 'seconds'::text))))::double precision, r.seconds) AS seconds,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'changes'::text) AND (c.key = ((((r.robot || '/'::text) || r.from_state) || '/'::text) || r.to_state)) AND (c.column_name = 'joules'::text))))::double precision, r.joules) AS joules
   FROM adit.changes r;
CREATE TABLE adit.derivations (
    site text NOT NULL,
    class text NOT NULL,
    key text NOT NULL,
    property text NOT NULL,
    value text,
    rule bigint NOT NULL,
    witness bigint
);
CREATE TABLE adit.prime_area_strips (
    site text NOT NULL,
    area bigint NOT NULL,
    x_first bigint NOT NULL,
    x_last bigint NOT NULL,
    y_first bigint NOT NULL,
    y_last bigint NOT NULL,
    open bigint,
    open_rule bigint,
    open_witness bigint
);
CREATE TABLE adit.witnesses (
    site text NOT NULL,
    witness bigint NOT NULL,
    facts text NOT NULL
);
CREATE VIEW adit.conclusions AS
 SELECT c.site,
    ((c.class || '.'::text) || c.key) AS object,
    c.property,
    c.value,
    u.name AS rule,
    u.version,
    w.facts AS witness,
    c.class,
    c.key,
    u.file,
    u.line
   FROM ((( SELECT prime_area_strips.site,
            'prime_areas'::text AS class,
            (prime_area_strips.area)::text AS key,
            'open'::text AS property,
            (prime_area_strips.open)::text AS value,
            prime_area_strips.open_rule AS rule,
            prime_area_strips.open_witness AS witness
           FROM adit.prime_area_strips
          WHERE (prime_area_strips.open_rule IS NOT NULL)
        UNION ALL
         SELECT rooms.site,
            'rooms'::text,
            (rooms.room)::text AS room,
            'hardness'::text,
            (rooms.hardness)::text AS hardness,
            rooms.hardness_rule,
            rooms.hardness_witness
           FROM adit.rooms
          WHERE (rooms.hardness_rule IS NOT NULL)
        UNION ALL
         SELECT rooms.site,
            'rooms'::text,
            (rooms.room)::text AS room,
            'action'::text,
            rooms.action,
            rooms.action_rule,
            rooms.action_witness
           FROM adit.rooms
          WHERE (rooms.action_rule IS NOT NULL)
        UNION ALL
         SELECT rooms.site,
            'rooms'::text,
            (rooms.room)::text AS room,
            'passable'::text,
            (rooms.passable)::text AS passable,
            rooms.passable_rule,
            rooms.passable_witness
           FROM adit.rooms
          WHERE (rooms.passable_rule IS NOT NULL)
        UNION ALL
         SELECT doors.site,
            'doors'::text,
            (doors.door)::text AS door,
            'hardness'::text,
            (doors.hardness)::text AS hardness,
            doors.hardness_rule,
            doors.hardness_witness
           FROM adit.doors
          WHERE (doors.hardness_rule IS NOT NULL)
        UNION ALL
         SELECT doors.site,
            'doors'::text,
            (doors.door)::text AS door,
            'action'::text,
            doors.action,
            doors.action_rule,
            doors.action_witness
           FROM adit.doors
          WHERE (doors.action_rule IS NOT NULL)
        UNION ALL
         SELECT doors.site,
            'doors'::text,
            (doors.door)::text AS door,
            'passable'::text,
            (doors.passable)::text AS passable,
            doors.passable_rule,
            doors.passable_witness
           FROM adit.doors
          WHERE (doors.passable_rule IS NOT NULL)
        UNION ALL
         SELECT derivations.site,
            derivations.class,
            ((derivations.key)::json #>> '{}'::text[]),
            derivations.property,
            ((derivations.value)::json #>> '{}'::text[]),
            derivations.rule,
            derivations.witness
           FROM adit.derivations) c
     LEFT JOIN adit.rules u ON (((u.site = c.site) AND (u.rule = c.rule))))
     LEFT JOIN adit.witnesses w ON (((w.site = c.site) AND (w.witness = c.witness))));
CREATE TABLE adit.course_waypoints (
    site text NOT NULL,
    robot text NOT NULL,
    start text NOT NULL,
    goal text NOT NULL,
    waypoint bigint NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL,
    z double precision,
    heading double precision,
    state text,
    action text,
    clearance double precision,
    distance double precision,
    cost double precision NOT NULL,
    centre_x double precision,
    centre_y double precision,
    turn text,
    measures text
);
CREATE TABLE adit.courses (
    site text NOT NULL,
    robot text NOT NULL,
    start text NOT NULL,
    goal text NOT NULL,
    status text NOT NULL,
    reason text,
    remarks text NOT NULL,
    cost double precision,
    distance double precision,
    clearance double precision,
    steps bigint,
    measures text
);
CREATE TABLE adit.drawn (
    site text NOT NULL,
    fid bigint NOT NULL,
    geom bytea NOT NULL,
    name text,
    what text,
    kind text,
    properties text,
    until text,
    why text
);
CREATE TABLE adit.edges (
    site text NOT NULL,
    cell text NOT NULL,
    edge bigint NOT NULL,
    subgoal1 bigint NOT NULL,
    subgoal2 bigint NOT NULL,
    via text NOT NULL,
    loose bigint NOT NULL,
    length double precision NOT NULL,
    made_task bigint NOT NULL,
    verified_task bigint NOT NULL,
    verified_revision bigint NOT NULL,
    times_verified bigint NOT NULL,
    removed_task bigint,
    removed_revision bigint,
    broken_by text,
    because text
);
CREATE TABLE adit.endings (
    site text NOT NULL,
    ending text NOT NULL,
    meaning text NOT NULL
);
CREATE TABLE adit.told (
    site text NOT NULL,
    id bigint NOT NULL,
    class text NOT NULL,
    key text,
    x double precision,
    y double precision,
    x0 double precision,
    y0 double precision,
    x1 double precision,
    y1 double precision,
    property text NOT NULL,
    kind text NOT NULL,
    value text NOT NULL,
    until text,
    who text NOT NULL,
    why text NOT NULL,
    at text NOT NULL
);
CREATE TABLE adit.told_states (
    site text NOT NULL,
    told bigint NOT NULL,
    state text NOT NULL
);
CREATE VIEW adit.facts_told AS
 SELECT t.site,
    t.id,
    t.class,
    COALESCE(t.key, ((t.x || ','::text) || t.y)) AS object,
    t.property,
        CASE t.kind
            WHEN 'truth'::text THEN
            CASE t.value
                WHEN '1'::text THEN 'true'::text
                ELSE 'false'::text
            END
            ELSE ((t.value)::json #>> '{}'::text[])
        END AS value,
    t.until,
    s.state,
    ( SELECT (COALESCE(json_agg(a.key ORDER BY a.key), '[]'::json))::text AS "coalesce"
           FROM adit.attachments a
          WHERE ((a.site = t.site) AND (a.told = t.id))) AS objects,
    t.who,
    t.why,
    t.at
   FROM (adit.told t
     LEFT JOIN adit.told_states s ON (((s.site = t.site) AND (s.told = t.id))));
CREATE TABLE adit.files (
    site text NOT NULL,
    path text NOT NULL,
    bytes bytea NOT NULL
);
CREATE TABLE adit.floor_adits (
    site text NOT NULL,
    world text NOT NULL,
    adit bigint NOT NULL,
    doorway bigint NOT NULL,
    region bigint NOT NULL,
    twin bigint NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL
);
CREATE TABLE adit.floor_corners (
    site text NOT NULL,
    world text NOT NULL,
    region bigint NOT NULL,
    corner bigint NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL
);
CREATE TABLE adit.floor_doorways (
    site text NOT NULL,
    world text NOT NULL,
    doorway bigint NOT NULL,
    region1 bigint NOT NULL,
    region2 bigint NOT NULL,
    x0 double precision NOT NULL,
    y0 double precision NOT NULL,
    x1 double precision NOT NULL,
    y1 double precision NOT NULL,
    width double precision NOT NULL
);
CREATE TABLE adit.floor_places (
    site text NOT NULL,
    world text NOT NULL,
    place text NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL,
    region bigint
);
CREATE TABLE adit.floor_plans (
    site text NOT NULL,
    world text NOT NULL,
    rules text NOT NULL,
    radius double precision NOT NULL,
    margin double precision NOT NULL,
    area double precision NOT NULL,
    at text NOT NULL
);
CREATE TABLE adit.floor_regions (
    site text NOT NULL,
    world text NOT NULL,
    region bigint NOT NULL,
    area double precision NOT NULL
);
CREATE TABLE adit.floor_ways (
    site text NOT NULL,
    world text NOT NULL,
    way bigint NOT NULL,
    from_adit bigint,
    from_place text,
    to_adit bigint NOT NULL,
    doorway bigint,
    region bigint,
    length double precision NOT NULL,
    clearance double precision NOT NULL,
    weight double precision
);
CREATE TABLE adit.frames (
    site text NOT NULL,
    frame text NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL,
    yaw double precision NOT NULL
);
CREATE TABLE adit.history (
    site text NOT NULL,
    id bigint NOT NULL,
    at text NOT NULL,
    who text NOT NULL,
    why text NOT NULL,
    table_name text NOT NULL,
    key text NOT NULL,
    column_name text,
    old text,
    new text,
    undone bigint,
    change_set bigint
);
CREATE TABLE adit.hours (
    site text NOT NULL,
    name text NOT NULL,
    days text NOT NULL,
    opens text NOT NULL,
    closes text NOT NULL
);
CREATE TABLE adit.journal (
    site text NOT NULL,
    world text NOT NULL,
    mission bigint NOT NULL,
    entry bigint NOT NULL,
    "time" double precision NOT NULL,
    event text NOT NULL,
    state text,
    next text,
    action text,
    rule text,
    table_row bigint,
    file text,
    line bigint,
    x double precision NOT NULL,
    y double precision NOT NULL,
    heading double precision NOT NULL,
    true_x double precision,
    true_y double precision,
    true_heading double precision,
    detail text
);
CREATE TABLE adit.robots (
    site text NOT NULL,
    robot text NOT NULL,
    state text NOT NULL,
    action text NOT NULL,
    height double precision NOT NULL,
    width double precision NOT NULL,
    hardness double precision NOT NULL,
    "position" bigint NOT NULL,
    length double precision,
    speed double precision,
    power double precision
);
CREATE TABLE adit.site (
    site text NOT NULL,
    key text NOT NULL,
    value text NOT NULL
);
CREATE TABLE adit.sites (
    site text NOT NULL,
    entry bigint NOT NULL,
    generation bigint NOT NULL,
    worlds boolean NOT NULL,
    owner text,
    fence bigint DEFAULT 0 NOT NULL,
    ends timestamp with time zone
);
CREATE TABLE adit.stale_marks (
    site text NOT NULL,
    table_name text NOT NULL,
    key text NOT NULL
);
CREATE VIEW adit.staleness AS
 SELECT s.site,
        CASE
            WHEN ((EXISTS ( SELECT 1
               FROM adit.stale_marks m
              WHERE (m.site = s.site))) OR (EXISTS ( SELECT 1
               FROM adit.site v
              WHERE ((v.site = s.site) AND (v.key = 'valid_until'::text) AND (v.value <= to_char((now() AT TIME ZONE 'UTC'::text), 'YYYY-MM-DD"T"HH24:MI:SS"Z"'::text))))) OR (EXISTS ( SELECT 1
               FROM adit.site v
              WHERE ((v.site = s.site) AND (v.key = 'valid_from'::text) AND (v.value > to_char((now() AT TIME ZONE 'UTC'::text), 'YYYY-MM-DD"T"HH24:MI:SS"Z"'::text)))))) THEN 1
            ELSE 0
        END AS stale
   FROM adit.sites s;
CREATE VIEW adit.tree_measures AS
 SELECT g.site,
    g.tree,
    g.node,
    ( WITH RECURSIVE walk(node, prev, door, room, walked) AS (
                 SELECT g.node,
                    g.prev,
                    g.door,
                    COALESCE(g.from_room, g.prev, g.node) AS "coalesce",
                        CASE
                            WHEN (g.prev IS NULL) THEN (0.0)::double precision
                            ELSE g.walked
                        END AS walked
                UNION ALL
                 SELECT b.node,
                    b.prev,
                    b.door,
                    COALESCE(b.from_room, b.prev, b.node) AS "coalesce",
                        CASE
                            WHEN (b.prev IS NULL) THEN (0.0)::double precision
                            ELSE b.walked
                        END AS walked
                   FROM (walk
                     JOIN adit.tree_rows b ON (((b.site = g.site) AND (b.tree = g.tree) AND (b.node = walk.prev))))
                ), parts(measures, metres) AS (
                 SELECT r.measures,
                    walk.walked
                   FROM (walk
                     JOIN adit.rooms r ON (((r.site = g.site) AND (r.room = walk.room))))
                  WHERE ((walk.node = g.node) OR (walk.door IS NOT NULL) OR (walk.prev IS NULL))
                UNION ALL
                 SELECT d.measures,
                    (1.0)::double precision AS float8
                   FROM (walk
                     JOIN adit.doors d ON (((d.site = g.site) AND (d.door = walk.door))))
                ), totals(key, total) AS (
                 SELECT amounts.key,
                    sum(amounts.amount) AS sum
                   FROM ( SELECT e.key,
                                CASE
                                    WHEN ((e.value)::double precision = (0.0)::double precision) THEN (0.0)::double precision
                                    ELSE ((e.value)::double precision * parts.metres)
                                END AS amount
                           FROM (parts
                             CROSS JOIN LATERAL json_each_text((parts.measures)::json) e(key, value))) amounts
                  GROUP BY amounts.key
                 HAVING (count(amounts.amount) = ((1 + (2 * g.hops)) +
                        CASE
                            WHEN ((g.door IS NULL) AND (g.prev IS NOT NULL)) THEN 1
                            ELSE 0
                        END))
                )
         SELECT
                CASE
                    WHEN (count(totals.key) > 0) THEN (json_object_agg(totals.key, totals.total))::text
                    ELSE NULL::text
                END AS "case"
           FROM totals) AS measures
   FROM adit.tree_rows g;
CREATE VIEW adit.kept_routes AS
 SELECT b.site,
    b.robot,
    a.name AS start,
    e.name AS goal,
        CASE
            WHEN ((s.tree IS NULL) OR (e.kept = 0)) THEN 'not_kept'::text
            WHEN (( SELECT f.stale
               FROM adit.staleness f
              WHERE (f.site = b.site)) = 1) THEN 'stale'::text
            WHEN (t.hops IS NULL) THEN 'no_route'::text
            WHEN (t.hops = 0) THEN 'same_room'::text
            ELSE 'ok'::text
        END AS status,
    (t.reach + COALESCE(d.hardness, (0.0)::double precision)) AS cost,
    ((2 * t.hops) + 1) AS steps,
    t.distance,
    NULL::text AS reason,
    ( SELECT m.measures
           FROM adit.tree_measures m
          WHERE ((m.site = b.site) AND (m.tree = s.tree) AND (m.node = t.node))) AS measures
   FROM (((((( SELECT DISTINCT robots.site,
            robots.robot
           FROM adit.robots) b
     JOIN adit.ends a ON ((a.site = b.site)))
     JOIN adit.ends e ON ((e.site = b.site)))
     LEFT JOIN adit.starts s ON (((s.site = b.site) AND (s.name = a.name) AND (s.robot = b.robot))))
     LEFT JOIN adit.tree_rows t ON (((t.site = b.site) AND (t.tree = s.tree) AND (t.node = e.node))))
     LEFT JOIN adit.doors d ON (((d.site = b.site) AND (d.door = t.door))))
UNION ALL
 SELECT c.site,
    c.robot,
    c.start,
    c.goal,
        CASE
            WHEN (( SELECT f.stale
               FROM adit.staleness f
              WHERE (f.site = c.site)) = 1) THEN 'stale'::text
            ELSE c.status
        END AS status,
    c.cost,
    c.steps,
    c.distance,
    c.reason,
    c.measures
   FROM adit.courses c;
CREATE VIEW adit.kept_waypoints AS
 SELECT s.site,
    s.robot,
    s.name AS start,
    e.name AS goal,
    t.waypoint,
    COALESCE(t.x, d.x) AS x,
    COALESCE(t.y, d.y) AS y,
    ((t.heading)::double precision / (100.0)::double precision) AS heading,
    r.state,
    r.action,
    r.facing,
    t.clearance,
    t.distance,
    (t.reach + COALESCE(d.hardness, (0.0)::double precision)) AS cost,
    NULL::double precision AS z,
    NULL::double precision AS centre_x,
    NULL::double precision AS centre_y,
    NULL::text AS turn,
    ( SELECT m.measures
           FROM adit.tree_measures m
          WHERE ((m.site = s.site) AND (m.tree = s.tree) AND (m.node = t.node))) AS measures
   FROM ((((adit.starts s
     JOIN adit.ends e ON ((e.site = s.site)))
     CROSS JOIN LATERAL ( WITH RECURSIVE walk(site, tree, node, prev, from_room, door, reach, x, y, heading, distance, clearance, bend, stops, depth) AS (
                 SELECT g.site,
                    g.tree,
                    g.node,
                    g.prev,
                    g.from_room,
                    g.door,
                    g.reach,
                    g.x,
                    g.y,
                    g.heading,
                    g.distance,
                    g.clearance,
                    g.bend,
                    1 AS "?column?",
                    0 AS "?column?"
                   FROM adit.tree_rows g
                  WHERE ((g.site = s.site) AND (g.tree = s.tree) AND (g.node = e.node))
                UNION ALL
                 SELECT b.site,
                    b.tree,
                    b.node,
                    b.prev,
                    b.from_room,
                    b.door,
                    b.reach,
                    b.x,
                    b.y,
                    b.heading,
                    b.distance,
                    b.clearance,
                    b.bend,
                        CASE
                            WHEN ((walk_1.bend = 1) OR (b.prev IS NULL)) THEN 1
                            ELSE 0
                        END AS "case",
                    (walk_1.depth + 1)
                   FROM (walk walk_1
                     JOIN adit.tree_rows b ON (((b.site = walk_1.site) AND (b.tree = walk_1.tree) AND (b.node = walk_1.prev))))
                )
         SELECT walk.site,
            walk.tree,
            walk.node,
            walk.prev,
            walk.from_room,
            walk.door,
            walk.reach,
            walk.x,
            walk.y,
            walk.heading,
            walk.distance,
            walk.clearance,
            walk.bend,
            walk.stops,
            walk.depth,
            row_number() OVER (ORDER BY walk.depth DESC) AS waypoint
           FROM walk
          WHERE (walk.stops = 1)) t)
     LEFT JOIN adit.doors d ON (((d.site = s.site) AND (d.door = t.door))))
     LEFT JOIN adit.rooms r ON (((r.site = s.site) AND (r.room = COALESCE(t.from_room, t.prev, t.node)))))
UNION ALL
 SELECT course_waypoints.site,
    course_waypoints.robot,
    course_waypoints.start,
    course_waypoints.goal,
    course_waypoints.waypoint,
    course_waypoints.x,
    course_waypoints.y,
    course_waypoints.heading,
    course_waypoints.state,
    course_waypoints.action,
    NULL::double precision AS facing,
    course_waypoints.clearance,
    course_waypoints.distance,
    course_waypoints.cost,
    course_waypoints.z,
    course_waypoints.centre_x,
    course_waypoints.centre_y,
    course_waypoints.turn,
    course_waypoints.measures
   FROM adit.course_waypoints;
CREATE TABLE adit.laid (
    site text NOT NULL,
    name text NOT NULL,
    what text NOT NULL,
    kind text,
    outline text NOT NULL,
    properties text NOT NULL,
    until text,
    who text NOT NULL,
    why text NOT NULL,
    at text NOT NULL
);
CREATE TABLE adit.learned_buildings (
    site text NOT NULL,
    world text NOT NULL,
    learned text NOT NULL,
    rules text NOT NULL,
    seed text NOT NULL,
    radius double precision NOT NULL,
    start_x double precision NOT NULL,
    start_y double precision NOT NULL,
    length double precision NOT NULL,
    seconds double precision NOT NULL,
    at text NOT NULL
);
CREATE TABLE adit.learned_places (
    site text NOT NULL,
    world text NOT NULL,
    place text NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL
);
CREATE TABLE adit.learned_unseen (
    site text NOT NULL,
    world text NOT NULL,
    box bigint NOT NULL,
    x0 double precision NOT NULL,
    y0 double precision NOT NULL,
    x1 double precision NOT NULL,
    y1 double precision NOT NULL
);
CREATE TABLE adit.learned_walls (
    site text NOT NULL,
    world text NOT NULL,
    wall bigint NOT NULL,
    x0 double precision NOT NULL,
    y0 double precision NOT NULL,
    x1 double precision NOT NULL,
    y1 double precision NOT NULL
);
CREATE TABLE adit.loads (
    site text NOT NULL,
    robot text NOT NULL,
    load text NOT NULL,
    height double precision NOT NULL,
    width double precision NOT NULL,
    carried bigint NOT NULL
);
CREATE VIEW adit.loads_in_force AS
 SELECT r.site,
    r.robot,
    r.load,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'loads'::text) AND (c.key = ((r.robot || '/'::text) || r.load)) AND (c.column_name = 'height'::text))))::double precision, r.height) AS height,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'loads'::text) AND (c.key = ((r.robot || '/'::text) || r.load)) AND (c.column_name = 'width'::text))))::double precision, r.width) AS width,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'loads'::text) AND (c.key = ((r.robot || '/'::text) || r.load)) AND (c.column_name = 'carried'::text))))::bigint, r.carried) AS carried
   FROM adit.loads r;
CREATE TABLE adit.log (
    site text NOT NULL,
    entry bigint NOT NULL,
    generation bigint NOT NULL,
    owner text NOT NULL,
    fence bigint NOT NULL,
    at timestamp with time zone DEFAULT now() NOT NULL,
    changes text
);
CREATE TABLE adit.measures (
    site text NOT NULL,
    measure text NOT NULL,
    unit text NOT NULL
);
CREATE TABLE adit.missions (
    site text NOT NULL,
    world text NOT NULL,
    mission bigint NOT NULL,
    seed text NOT NULL,
    rules text NOT NULL,
    start_x double precision NOT NULL,
    start_y double precision NOT NULL,
    goal_x double precision NOT NULL,
    goal_y double precision NOT NULL,
    obstacles bigint NOT NULL,
    ending text NOT NULL,
    length double precision NOT NULL,
    optimum double precision,
    seconds double precision NOT NULL,
    at text NOT NULL,
    robot text
);
CREATE TABLE adit.object_changes (
    site text NOT NULL,
    cell text NOT NULL,
    revision bigint NOT NULL,
    object text NOT NULL,
    task bigint NOT NULL,
    how text NOT NULL
);
CREATE TABLE adit.site_hours (
    site text NOT NULL,
    name text NOT NULL,
    days text NOT NULL,
    opens text NOT NULL,
    closes text NOT NULL
);
CREATE VIEW adit.opening_hours AS
 SELECT site_hours.site,
    site_hours.name,
    site_hours.days,
    site_hours.opens,
    site_hours.closes,
    'site.toml'::text AS source
   FROM adit.site_hours
UNION ALL
 SELECT hours.site,
    hours.name,
    hours.days,
    hours.opens,
    hours.closes,
    'hours'::text AS source
   FROM adit.hours;
CREATE TABLE adit.own_objects (
    site text NOT NULL,
    kind text NOT NULL,
    name text NOT NULL,
    of_table text NOT NULL,
    sql text NOT NULL
);
CREATE TABLE adit.own_rows (
    site text NOT NULL,
    table_name text NOT NULL,
    key text NOT NULL,
    "row" text NOT NULL
);
CREATE TABLE adit.places (
    site text NOT NULL,
    place text NOT NULL,
    x double precision NOT NULL,
    y double precision NOT NULL
);
CREATE VIEW adit.robots_in_force AS
 SELECT r.site,
    r.robot,
    r.state,
    COALESCE(( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'action'::text))), r.action) AS action,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'height'::text))))::double precision, r.height) AS height,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'width'::text))))::double precision, r.width) AS width,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'length'::text))))::double precision, r.length) AS length,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'hardness'::text))))::double precision, r.hardness) AS hardness,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'position'::text))))::bigint, r."position") AS "position",
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'speed'::text))))::double precision, r.speed) AS speed,
    COALESCE((( SELECT c.value
           FROM adit.cells_in_force c
          WHERE ((c.site = r.site) AND (c.table_name = 'robots'::text) AND (c.key = ((r.robot || '/'::text) || r.state)) AND (c.column_name = 'power'::text))))::double precision, r.power) AS power
   FROM adit.robots r;
CREATE VIEW adit.route AS
 SELECT kept_routes.site,
    kept_routes.robot,
    kept_routes.start,
    kept_routes.goal,
    kept_routes.status,
    kept_routes.cost,
    kept_routes.steps,
    kept_routes.distance,
    kept_routes.reason,
    (((kept_routes.measures)::json ->> 'seconds'::text))::double precision AS seconds,
    (((kept_routes.measures)::json ->> 'joules'::text))::double precision AS joules,
    kept_routes.measures
   FROM adit.kept_routes;
CREATE VIEW adit.routes AS
 SELECT s.site,
    s.robot,
    s.name AS start,
    r.room,
    (t.reach + COALESCE(d.hardness, (0.0)::double precision)) AS cost,
    t.door AS from_door,
    COALESCE(t.from_room, t.prev) AS from_room,
    r.name AS room_name,
    t.hops
   FROM ((((adit.starts s
     JOIN adit.rooms r ON (((r.site = s.site) AND ((r.robot IS NULL) OR (r.robot = s.robot)))))
     JOIN adit.ends e ON (((e.site = s.site) AND (e.name = r.name) AND (e.kept = 1))))
     LEFT JOIN adit.tree_rows t ON (((t.site = s.site) AND (t.tree = s.tree) AND (t.node = r.room))))
     LEFT JOIN adit.doors d ON (((d.site = s.site) AND (d.door = t.door))));
CREATE TABLE adit.saved_queries (
    site text NOT NULL,
    name text NOT NULL,
    query text NOT NULL,
    who text NOT NULL,
    at text NOT NULL
);
CREATE TABLE adit.sequences (
    site text NOT NULL,
    name text NOT NULL,
    last bigint NOT NULL
);
CREATE TABLE adit.strategies (
    site text NOT NULL,
    cell text NOT NULL,
    revision bigint NOT NULL,
    task bigint NOT NULL,
    strategy text NOT NULL,
    facts text NOT NULL,
    rule text,
    table_row bigint,
    file text,
    line bigint
);
CREATE TABLE adit.strips (
    site text NOT NULL,
    axis text NOT NULL,
    strip bigint NOT NULL,
    low double precision NOT NULL,
    high double precision NOT NULL
);
CREATE TABLE adit.subgoal_pairs (
    site text NOT NULL,
    cell text NOT NULL,
    subgoal1 bigint NOT NULL,
    subgoal2 bigint NOT NULL,
    kind text NOT NULL,
    revision bigint NOT NULL
);
CREATE TABLE adit.subgoals (
    site text NOT NULL,
    cell text NOT NULL,
    subgoal bigint NOT NULL,
    configuration text NOT NULL,
    object text,
    tool_x double precision,
    tool_y double precision,
    tool_heading_rad double precision,
    branch bigint,
    made_task bigint NOT NULL,
    removed_task bigint,
    because text
);
CREATE TABLE adit.tasks (
    site text NOT NULL,
    cell text NOT NULL,
    task bigint NOT NULL,
    goal text NOT NULL,
    configuration text,
    found bigint NOT NULL,
    reason text,
    evaluations bigint NOT NULL,
    solve_calls bigint NOT NULL,
    reach_calls bigint NOT NULL,
    length double precision,
    path text,
    at text NOT NULL
);
CREATE TABLE adit.traversals (
    site text NOT NULL,
    id bigint NOT NULL,
    mission text,
    robot text NOT NULL,
    state text NOT NULL,
    distance double precision NOT NULL,
    measured double precision NOT NULL,
    measure text NOT NULL,
    who text NOT NULL,
    at text NOT NULL
);
CREATE TABLE adit.version (
    one bigint NOT NULL,
    version bigint NOT NULL,
    CONSTRAINT version_one_check CHECK ((one = 1))
);
CREATE VIEW adit.waypoints AS
 SELECT kept_waypoints.site,
    kept_waypoints.robot,
    kept_waypoints.start,
    kept_waypoints.goal,
    kept_waypoints.waypoint,
    kept_waypoints.x,
    kept_waypoints.y,
    kept_waypoints.heading,
    kept_waypoints.state,
    kept_waypoints.action,
    kept_waypoints.facing,
    kept_waypoints.clearance,
    kept_waypoints.distance,
    kept_waypoints.cost,
    kept_waypoints.z,
    kept_waypoints.centre_x,
    kept_waypoints.centre_y,
    kept_waypoints.turn,
    (((kept_waypoints.measures)::json ->> 'seconds'::text))::double precision AS seconds,
    (((kept_waypoints.measures)::json ->> 'joules'::text))::double precision AS joules,
    kept_waypoints.measures
   FROM adit.kept_waypoints;
COPY adit.active_tunings (site, tuning) FROM stdin;
\.
COPY adit.area_outlines (site, area, kind, outline, heading) FROM stdin;
\.
COPY adit.attachments (site, told, key) FROM stdin;
\.
COPY adit.cell_objects (site, cell, object, number, revision, times_moved, movable, x, y, heading_rad, polygon) FROM stdin;
\.
COPY adit.cells (site, cell, robot, seed, tasks, revision, next_subgoal, next_edge, configuration, stands, figures, copied_from, at) FROM stdin;
\.
COPY adit.changes (site, robot, from_state, to_state, hardness, seconds, joules) FROM stdin;
\.
COPY adit.course_steps (site, robot, start, goal, step, kind, place, state, action, hardness, cost, x, y, z, heading, rule, measures) FROM stdin;
world	robot	bath	desk	1	region	region 5	\N	DRIVE	2.1300515594976845	2.1300515594976845	10	7.267115530169647	\N	-159.87503245064167	a way weighs its length	\N
world	robot	bath	desk	2	doorway	doorway 6	\N	DRIVE	0	2.1300515594976845	10	7.267115530169647	\N	-159.87503245064167	a way weighs its length	\N
world	robot	bath	desk	3	region	region 7	\N	DRIVE	2.4306791957198874	4.5607307552175715	8.24644518494606	5.6	\N	-135.00000000000003	a way weighs its length	\N
world	robot	bath	desk	4	doorway	doorway 4	\N	DRIVE	0	4.5607307552175715	8.24644518494606	5.6	\N	-135.00000000000003	a way weighs its length	\N
world	robot	bath	desk	5	region	region 1	\N	DRIVE	2.209844718488146	6.770575473705717	6.747560731713906	4	\N	-95.65523740001237	a way weighs its length	\N
world	robot	bath	desk	6	doorway	doorway 2	\N	DRIVE	0	6.770575473705717	6.747560731713906	4	\N	-95.65523740001237	a way weighs its length	\N
world	robot	bath	desk	7	region	region 3	\N	DRIVE	2.5122273615034776	9.282802835209194	6.5	1.5	\N	-95.65523740001147	a way weighs its length	\N
\.
COPY adit.course_waypoints (site, robot, start, goal, waypoint, x, y, z, heading, state, action, clearance, distance, cost, centre_x, centre_y, turn, measures) FROM stdin;
world	robot	bath	desk	1	12	8	\N	\N	\N	\N	\N	0	0	\N	\N	\N	\N
world	robot	bath	desk	2	9.927077397704124	7.240393608808517	\N	-159.87503245064167	\N	\N	0.0012106547931128864	2.207716010869164	2.207716010869164	\N	\N	\N	\N
world	robot	bath	desk	3	9.881580114364624	7.221548005938529	\N	-157.499988112005	\N	\N	1.0015594032464215e-06	2.2569619197226722	2.2569619197226722	\N	\N	\N	\N
world	robot	bath	desk	4	9.840633645653725	7.194188460707664	\N	-146.25001011882765	\N	\N	1.0024092871319112e-06	2.3062078131061052	2.3062078131061052	\N	\N	\N	\N
world	robot	bath	desk	5	6.805811539292335	4.159366354346274	\N	-135.00000000000003	\N	\N	1.0072457964915849e-06	6.598094395312065	6.598094395312065	\N	\N	\N	\N
world	robot	bath	desk	6	6.778451994061469	4.118419885635375	\N	-123.74998988117237	\N	\N	1.0024092884086677e-06	6.647340288695498	6.647340288695498	\N	\N	\N	\N
world	robot	bath	desk	7	6.759606391191482	4.072922602295875	\N	-112.500011887995	\N	\N	1.0015594044121556e-06	6.696586197549007	6.696586197549007	\N	\N	\N	\N
world	robot	bath	desk	8	6.749999001622199	4.0246229469776145	\N	-101.24998948618614	\N	\N	1.0024682318143796e-06	6.745832097258513	6.745832097258513	\N	\N	\N	\N
world	robot	bath	desk	9	6.5	1.5	\N	-95.65523740001149	\N	\N	0.0012106460876202818	9.282802835209196	9.282802835209194	\N	\N	\N	\N
\.
COPY adit.courses (site, robot, start, goal, status, reason, remarks, cost, distance, clearance, steps, measures) FROM stdin;
world	robot	bath	bed	ok	\N		13.42046840228453	13.420468402284525	1.000182720756193e-06	7	\N
world	robot	bath	desk	ok	\N		9.282802835209194	9.282802835209196	1.0015594032464215e-06	7	\N
world	robot	bath	hall	ok	\N		8.840031740661988	8.840031740661988	9.946017420769948e-07	5	\N
world	robot	bath	kitchen	ok	\N		12.606067124804667	12.606067124804664	9.974421058545069e-07	7	\N
world	robot	bath	living room	ok	\N		3.627328965112615	3.627328965112615	9.983778008759714e-07	5	\N
world	robot	bath	store	ok	\N		9.312021963081271	9.312021963081273	9.946017420769948e-07	7	\N
world	robot	bed	bath	ok	\N		13.420468402284527	13.420468402284527	1.000182720756193e-06	7	\N
world	robot	bed	desk	ok	\N		9.40912326358926	9.409123263589262	9.983777990996145e-07	5	\N
world	robot	bed	hall	ok	\N		13.017884737111041	13.017884737111041	1.001559403412955e-06	3	\N
world	robot	bed	kitchen	ok	\N		6.5812919934571585	6.5812919934571585	0.0003286623313455417	5	\N
world	robot	bed	living room	ok	\N		11.881493915576778	11.881493915576776	9.974421039116166e-07	9	\N
world	robot	bed	store	ok	\N		12.808986389125131	12.808986389125133	9.953975688148375e-07	7	\N
world	robot	desk	bath	ok	\N		9.282802835209194	9.282802835209196	1.0015594032464215e-06	7	\N
world	robot	desk	bed	ok	\N		9.409123263589262	9.409123263589262	9.983777990996145e-07	5	\N
world	robot	desk	hall	ok	\N		7.449482197928399	7.4494821979284	9.99545263946633e-07	5	\N
world	robot	desk	kitchen	ok	\N		8.904407636243548	8.904407636243548	9.974421058545069e-07	5	\N
world	robot	desk	living room	ok	\N		7.7824942844489255	7.782494284448925	9.974421039116166e-07	9	\N
world	robot	desk	store	ok	\N		5.024937810560445	5.024937810560445	0.19776673559449526	3	\N
world	robot	hall	bath	ok	\N		8.840031740661988	8.840031740661988	9.946017420769948e-07	5	\N
world	robot	hall	bed	ok	\N		13.017884737111041	13.01788473711104	1.001559403412955e-06	3	\N
world	robot	hall	desk	ok	\N		7.4494821979284005	7.4494821979284	9.99545263946633e-07	5	\N
world	robot	hall	kitchen	ok	\N		12.322688234933304	12.322688234933302	9.974421058545069e-07	3	\N
world	robot	hall	living room	ok	\N		7.564046010665313	7.564046010665313	9.946017420769948e-07	7	\N
world	robot	hall	store	ok	\N		4.833671757475177	4.833671757475176	9.98377799987793e-07	3	\N
world	robot	kitchen	bath	ok	\N		12.606067124804667	12.606067124804667	9.974421058545069e-07	7	\N
world	robot	kitchen	bed	ok	\N		6.5812919934571585	6.5812919934571585	0.0003286623313455417	5	\N
world	robot	kitchen	desk	ok	\N		8.904407636243546	8.904407636243548	9.974421058545069e-07	5	\N
world	robot	kitchen	hall	ok	\N		12.322688234933306	12.322688234933306	9.974421058545069e-07	3	\N
world	robot	kitchen	living room	ok	\N		11.067092638096918	11.067092638096918	9.974421039116166e-07	9	\N
world	robot	kitchen	store	ok	\N		12.304270761779419	12.304270761779419	9.953975688148375e-07	7	\N
world	robot	living room	bath	ok	\N		3.6273289651126155	3.627328965112615	9.983778008759714e-07	5	\N
world	robot	living room	bed	ok	\N		11.88149391557678	11.881493915576776	9.974421039116166e-07	9	\N
world	robot	living room	desk	ok	\N		7.782494284448925	7.782494284448926	9.974421039116166e-07	9	\N
world	robot	living room	hall	ok	\N		7.564046010665313	7.564046010665313	9.946017420769948e-07	7	\N
world	robot	living room	kitchen	ok	\N		11.067092638096918	11.067092638096916	9.974421039116166e-07	9	\N
world	robot	living room	store	ok	\N		8.036036233084598	8.036036233084598	9.946017420769948e-07	9	\N
world	robot	store	bath	ok	\N		9.312021963081271	9.312021963081273	9.946017420769948e-07	7	\N
world	robot	store	bed	ok	\N		12.808986389125135	12.80898638912513	9.953975688148375e-07	7	\N
world	robot	store	desk	ok	\N		5.024937810560445	5.024937810560445	0.19776673559449526	3	\N
world	robot	store	hall	ok	\N		4.833671757475176	4.833671757475176	9.98377799987793e-07	3	\N
world	robot	store	kitchen	ok	\N		12.304270761779419	12.304270761779417	9.953975688148375e-07	7	\N
world	robot	store	living room	ok	\N		8.036036233084598	8.036036233084598	9.946017420769948e-07	9	\N
\.
COPY adit.derivations (site, class, key, property, value, rule, witness) FROM stdin;
store	orders	"1"	discount	0.05	2	\N
store	orders	"1"	express	0	6	\N
store	orders	"1"	goes_out	1	5	\N
store	orders	"1"	goods	39.9	1	\N
store	orders	"1"	grams	1200.0	1	\N
store	orders	"1"	shipping	7.0	3	1289592934033724349
store	orders	"1"	total	44.904999999999994	4	\N
store	orders	"2"	discount	0.1	2	\N
store	orders	"2"	express	0	6	\N
store	orders	"2"	goes_out	1	5	\N
store	orders	"2"	goods	50.400000000000006	1	\N
store	orders	"2"	grams	1200.0	1	\N
store	orders	"2"	shipping	4.0	3	5056091989359768725
store	orders	"2"	total	49.36000000000001	4	\N
store	orders	"3"	discount	0.05	2	\N
store	orders	"3"	express	0	6	\N
store	orders	"3"	goes_out	0	5	\N
store	orders	"3"	goods	39.0	1	\N
store	orders	"3"	grams	1500.0	1	\N
store	orders	"3"	shipping	21.0	3	7544477349256158821
store	orders	"3"	total	58.05	4	\N
store	orders	"4"	discount	0.1	2	\N
store	orders	"4"	express	0	6	\N
store	orders	"4"	goes_out	1	5	\N
store	orders	"4"	goods	79.8	1	\N
store	orders	"4"	grams	2400.0	1	\N
store	orders	"4"	shipping	0.0	3	5056091989359768725
store	orders	"4"	total	71.82	4	\N
store	orders	"5"	discount	0.05	2	\N
store	orders	"5"	express	0	6	\N
store	orders	"5"	goes_out	1	5	\N
store	orders	"5"	goods	12.600000000000001	1	\N
store	orders	"5"	grams	300.0	1	\N
store	orders	"5"	shipping	7.0	3	1289592934033724349
store	orders	"5"	total	18.97	4	\N
world	doorways	"0"	blocked	0	26	\N
world	doorways	"0"	name	"doorway 0"	1	\N
world	doorways	"1"	blocked	0	26	\N
world	doorways	"1"	name	"doorway 1"	1	\N
world	doorways	"10"	blocked	0	26	\N
world	doorways	"10"	name	"doorway 10"	1	\N
world	doorways	"11"	blocked	0	26	\N
world	doorways	"11"	name	"doorway 11"	1	\N
world	doorways	"2"	blocked	0	26	\N
world	doorways	"2"	name	"doorway 2"	1	\N
world	doorways	"3"	blocked	0	26	\N
world	doorways	"3"	name	"doorway 3"	1	\N
world	doorways	"4"	blocked	0	26	\N
world	doorways	"4"	name	"doorway 4"	1	\N
world	doorways	"5"	blocked	0	26	\N
world	doorways	"5"	name	"doorway 5"	1	\N
world	doorways	"6"	blocked	0	26	\N
world	doorways	"6"	name	"doorway 6"	1	\N
world	doorways	"7"	blocked	0	26	\N
world	doorways	"7"	name	"doorway 7"	1	\N
world	doorways	"8"	blocked	0	26	\N
world	doorways	"8"	name	"doorway 8"	1	\N
world	doorways	"9"	blocked	0	26	\N
world	doorways	"9"	name	"doorway 9"	1	\N
\.
COPY adit.doors (site, door, kind, room1, room2, x, y, width, height1, width1, distance1, height2, width2, distance2, hardness, action, passable, one_way, x0, y0, x1, y1, hardness_rule, hardness_witness, action_rule, action_witness, passable_rule, passable_witness, measures) FROM stdin;
\.
COPY adit.doorways (site, doorway, called, name, space1, space2, x, y, x0, y0, x1, y1, width, height, closed, closed_from) FROM stdin;
world	0	\N	doorway 0	0	1	2.5	5.6	3	5.6	2	5.6	1	\N	\N	\N
world	1	\N	doorway 1	1	2	2	4	2.5	4	1.5	4	1	\N	\N	\N
world	2	\N	doorway 2	1	3	6.5	4	6	4	7	4	1	\N	\N	\N
world	3	\N	doorway 3	1	4	10	4	10.5	4	9.5	4	1	\N	\N	\N
world	4	\N	doorway 4	1	7	8.05	5.6	8.6	5.6	7.5	5.6	1.0999999999999996	\N	\N	\N
world	5	\N	doorway 5	3	4	9	1.7000000000000002	9	1.2	9	2.2	1.0000000000000002	\N	\N	\N
world	6	\N	doorway 6	5	7	10	7.3	10	7	10	7.6	0.5999999999999996	\N	\N	\N
world	7	\N	doorway 7	5	8	10	7.8	10	7.6	10	8	0.40000000000000036	\N	\N	\N
world	8	\N	doorway 8	6	8	8.7	8	7.4	8	10	8	2.5999999999999996	\N	\N	\N
world	9	\N	doorway 9	6	9	6.25	8	7	8	5.5	8	1.5	\N	\N	\N
world	10	\N	doorway 10	7	8	8.7	7.6	7.4	7.6	10	7.6	2.5999999999999996	\N	\N	\N
world	11	\N	doorway 11	7	9	6.25	7.6	7	7.6	5.5	7.6	1.5	\N	\N	\N
\.
COPY adit.drawn (site, fid, geom, name, what, kind, properties, until, why) FROM stdin;
\.
COPY adit.edges (site, cell, edge, subgoal1, subgoal2, via, loose, length, made_task, verified_task, verified_revision, times_verified, removed_task, removed_revision, broken_by, because) FROM stdin;
\.
COPY adit.endings (site, ending, meaning) FROM stdin;
world	arrived	the robot says that it stands at its goal
world	gave_up	it took longer than the navigator has patience
world	lost	it says that it does not know where it is
world	no_way	it says that there is no way there
world	silent	it was not heard any more, or what it said made no sense
\.
COPY adit.ends (site, name, node, kind, kept) FROM stdin;
\.
COPY adit.files (site, path, bytes) FROM stdin;
store	rules/orders.rhai	\\x2f2f205768617420616e206f7264657220636f7374732c20616e64207768657468657220697420676f6573206f75742e20546865207461626c65732061726520696e202e2e2f7461626c65733b206564697420612063656c6c20776974682060616469742074756e65602c20616e64207768617420666f6c6c6f77732069730a2f2f20636f6e636c7564656420616e65772e0a0a70726f7065727479204f52444552532e637573746f6d6572206e616d657320435553544f4d4552533b0a70726f7065727479204f52444552532e70726f64756374206e616d65732050524f44554354533b0a70726f7065727479204f52444552532e657870726573732066726f6d207461626c652c2064656661756c742066616c73653b0a0a72756c652022776861742074686520676f6f6473206f6620616e206f7264657220636f737420616e64207765696768220a2020202065616368206f7264657220696e204f52444552530a202020207468656e207b0a20202020202020206f726465722e676f6f6473203d206f726465722e706965636573202a206f726465722e70726f647563742e70726963653b0a20202020202020206f726465722e6772616d73203d206f726465722e706965636573202a206f726465722e70726f647563742e6772616d733b0a202020207d0a0a2f2f202020202020202020202020676f6f647320666f72202020202020202020202020206d656d626572206f660a2f2f2020202020202020202020202020202020202020202020202020202020202020202074686520636c75620a7461626c652022646973636f756e74222066697273740a2020202065616368206f7264657220696e204f52444552530a20202020676976656e205b206f726465722e676f6f64732c2020202020202020202020206f726465722e637573746f6d65722e636c7562203f3f2066616c7365205d0a202020207365742020205b206f726465722e646973636f756e74205d0a20202020726f777320205b205b2061745f6c65617374283130302e30292c202020202020616e792c202020302e3135205d2c0a2020202020202020202020205b206265747765656e2835302e302c203130302e30292c20616e792c202020302e3130205d2c0a2020202020202020202020205b2062656c6f772835302e30292c20202020202020202020747275652c2020302e3035205d2c0a2020202020202020202020205b2062656c6f772835302e30292c2020202020202020202066616c73652c20302e30205d205d0a0a72756c6520227768617420697420636f73747320746f2073656e6420616e206f72646572220a2020202065616368206f7264657220696e204f52444552530a20202020736f6d65207a6f6e652020696e205a4f4e4553207768657265207a6f6e652e636f756e747279203d3d206f726465722e637573746f6d65722e636f756e747279202626207a6f6e652e65787072657373203d3d206f726465722e657870726573730a202020207468656e207b206f726465722e7368697070696e67203d206966206f726465722e676f6f6473202a2028312e30202d206f726465722e646973636f756e7429203e3d2036302e30207b20302e30207d20656c7365207b207a6f6e652e666565207d3b207d0a0a72756c6520227768617420616e206f7264657220636f737473220a2020202065616368206f7264657220696e204f52444552530a202020207468656e207b206f726465722e746f74616c203d206f726465722e676f6f6473202a2028312e30202d206f726465722e646973636f756e7429202b206f726465722e7368697070696e673b207d0a0a72756c652022616e206f7264657220676f6573206f7574207768656e20616c6c206f66206974206973207468657265220a2020202065616368206f7264657220696e204f52444552530a202020207468656e207b206f726465722e676f65735f6f7574203d206f726465722e706965636573203c3d206f726465722e70726f647563742e73746f636b3b207d0a
store	rules/tests/orders.toml	\\x5b676976656e5d0a435553544f4d455253203d205b7b20637573746f6d6572203d2022416461222c20636f756e747279203d2022554b222c20636c7562203d2074727565207d2c207b20637573746f6d6572203d202244617261222c20636f756e747279203d2022444522207d5d0a50524f445543545320203d205b7b2070726f64756374203d20226b6574746c65222c207072696365203d2034302e302c206772616d73203d20313230302e302c2073746f636b203d2031207d5d0a5a4f4e455320202020203d205b7b20636f756e747279203d2022554b222c2065787072657373203d2066616c73652c20666565203d20372e30207d2c207b20636f756e747279203d20224445222c2065787072657373203d2066616c73652c20666565203d20342e30207d5d0a4f5244455253202020203d205b7b206f72646572203d20312c20637573746f6d6572203d2022416461222c2070726f64756374203d20226b6574746c65222c20706965636573203d2031207d2c0a202020202020202020202020207b206f72646572203d20322c20637573746f6d6572203d202244617261222c2070726f64756374203d20226b6574746c65222c20706965636573203d2032207d5d0a0a5b5b746573745d5d0a6e616d65203d20226d656d6265727320736176652061206c6974746c652c206c61726765206f7264657273206d6f72652c20616e6420746865736520636f7374206e6f7468696e6720746f2073656e64220a5b746573742e636f6e636c7564655d0a4f52444552532e31203d207b20676f6f6473203d2034302e302c20646973636f756e74203d20302e30352c207368697070696e67203d20372e302c20746f74616c203d2034352e302c20676f65735f6f7574203d2074727565207d0a4f52444552532e32203d207b20676f6f6473203d2038302e302c20646973636f756e74203d20302e312c207368697070696e67203d20302e302c20746f74616c203d2037322e302c20676f65735f6f7574203d2066616c7365207d0a5b5b746573742e7468656e5d5d0a74656c6c2e50524f44554354532e6b6574746c652e7072696365203d2036302e300a636f6e636c7564652e4f52444552532e32203d207b20646973636f756e74203d20302e31352c20746f74616c203d203130322e30207d0a
store	site.toml	\\x6e616d6520203d202273686f70220a726f6f6d73203d20226e6f6e65222020202020202020202020202023206e6f206d61703a207461626c657320616e642072756c657320616c6f6e650a232074696d657a6f6e65203d20224575726f70652f4265726c696e220a
store	tables/customers.csv	\\x637573746f6d65722c636f756e7472792c73696e63652c636c75620a4164612c554b2c323031392c747275650a4272756e6f2c44452c323032342c66616c73650a436869796f2c4a502c323032312c747275650a446172612c44452c323032352c0a
store	tables/orders.csv	\\x6f726465722c637573746f6d65722c70726f647563742c7069656365730a312c4164612c6b6574746c652c310a322c4272756e6f2c7465612c31320a332c436869796f2c6375702c360a342c446172612c6b6574746c652c320a352c4164612c7465612c330a
store	tables/products.csv	\\x70726f647563742c70726963652c6772616d732c73746f636b0a6b6574746c652c33392e39302c313230302c31340a6375702c362e35302c3235302c300a7465612c342e32302c3130302c3233300a
store	tables/zones.csv	\\x636f756e7472792a2c657870726573732a2c6665650a554b2c747275652c31390a554b2c66616c73652c370a44452c747275652c31320a44452c66616c73652c340a4a502c747275652c33380a4a502c66616c73652c32310a
world	flat.json	\\x7b0a20226e616d65223a2022666c6174222c0a2022756e697473223a20226d222c0a202277616c6c73223a205b0a20205b5b302c20305d2c205b31322c20305d5d2c0a20205b5b31322c20305d2c205b31342c20325d5d2c0a20205b5b31342c20325d2c205b31342c2031305d5d2c0a20205b5b31342c2031305d2c205b302c2031305d5d2c0a20205b5b302c2031305d2c205b302c20305d5d2c0a20205b5b302c20345d2c205b312e352c20345d5d2c0a20205b5b322e352c20345d2c205b362c20345d5d2c0a20205b5b372c20345d2c205b392e352c20345d5d2c0a20205b5b31302e352c20345d2c205b31342c20345d5d2c0a20205b5b342e352c20305d2c205b342e352c20345d5d2c0a20205b5b392c20305d2c205b392c20312e325d5d2c0a20205b5b392c20322e325d2c205b392c20345d5d2c0a20205b5b302c20352e365d2c205b322c20352e365d5d2c0a20205b5b332c20352e365d2c205b372e352c20352e365d5d2c0a20205b5b382e362c20352e365d2c205b31342c20352e365d5d2c0a20205b5b352e352c20352e365d2c205b352e352c2031305d5d2c0a20205b5b31302c20352e365d2c205b31302c20375d5d2c0a20205b5b31302c20385d2c205b31302c2031305d5d2c0a20205b5b372c20372e365d2c205b372e342c20372e365d5d2c0a20205b5b372e342c20372e365d2c205b372e342c20385d5d2c0a20205b5b372e342c20385d2c205b372c20385d5d2c0a20205b5b372c20385d2c205b372c20372e365d5d0a205d2c0a2022706c61636573223a205b0a20207b226e616d65223a2022626564222c20226174223a205b312e352c20312e355d7d2c0a20207b226e616d65223a20226465736b222c20226174223a205b362e352c20312e355d7d2c0a20207b226e616d65223a202273746f7265222c20226174223a205b31312e352c20322e305d7d2c0a20207b226e616d65223a202268616c6c222c20226174223a205b31322e352c20342e385d7d2c0a20207b226e616d65223a20226b69746368656e222c20226174223a205b322e352c20382e305d7d2c0a20207b226e616d65223a20226c6976696e6720726f6f6d222c20226174223a205b382e382c20382e385d7d2c0a20207b226e616d65223a202262617468222c20226174223a205b31322c20385d7d0a205d0a7d0a
world	flat.toml	\\x23204120666c6f6f7220706c616e3a2077616c6c7320616e6420706c61636573207374616e6420696e20746865204a534f4e2066696c65206265736964652074686973206f6e652e20606164697420726f75746520666c61742e746f6d6c206265642062617468602066696e6473206120706174682c0a232060616469742073696d756c61746520666c61742e746f6d6c202d2d6d697373696f6e73203130202d2d66696c6d2066696c6d2e737667602073656e647320612073696d756c6174656420726f626f742c207769746820626f78657320696e2069747320776179207468617420697420646f6573206e6f74206b6e6f772e0a0a5b666c6f6f725f706c616e5d0a66696c6520203d2022666c61742e6a736f6e220a726f626f74203d207b20726164697573203d20302e32352c206d617267696e203d20302e30207d0a
world	rules/own.rhai	\\x2f2f205468652072756c6573206f66207468697320736974652e2054686579206c6965206f7665722074686f73652074686174207468652070726f6772616d20636172726965733a206e617669676174696f6e2e0a2f2f20412072756c652068657265207265706c6163657320746865206f6e65206f66207468652073616d65206e616d652074686572652c20616e6420616e79206f746865722069732061646465643b2060776974686f75742022612072756c6522602074616b6573206f6e6520617761792e0a2f2f2060616469742072756c6573205349544560206c69737473207768617420636f756e74732c2060616469742072756c657320534954452022612072756c652260207072696e7473206f6e6520746f20626567696e20776974682c20606164697420636865636b205349544560207361797320776861742069730a2f2f207265706c616365642e205465737473206f662074686573652072756c6573206c696520696e2072756c65732f74657374732f2a2e746f6d6c2e0a
world	site.toml	\\x6e616d65203d2022776f726c64220a6d617020203d2022666c61742e746f6d6c2220202020202020202020202020202020232066696c6c73207461626c6573206f6e63653b2066726f6d207468656e206f6e2060616469742074756e6560206368616e676573207468656d0a232072756c6573203d20226e617669676174696f6e222020232077686174206c6965732062656e656174682074686520666f6c6465722072756c65733b206120666f6c6465722c206f722061206c697374206f6620736f6d653b202272756c6573223a206e6f7468696e6720646f65730a2320737461727473203d205b22646f636b225d202020202020232066726f6d20776865726520726f7574657320617265206b6570743b20657665727920706c61636520776974686f75742074686973206c696e650a23205b5b706c6163655d5d202020202020202020202020202020202320696e20746865206d6170277320636f6f7264696e617465730a23206e616d65203d2022646f636b220a232061742020203d205b312e302c20322e305d0a
\.
COPY adit.floor_adits (site, world, adit, doorway, region, twin, x, y) FROM stdin;
\.
COPY adit.floor_corners (site, world, region, corner, x, y) FROM stdin;
\.
COPY adit.floor_doorways (site, world, doorway, region1, region2, x0, y0, x1, y1, width) FROM stdin;
\.
COPY adit.floor_places (site, world, place, x, y, region) FROM stdin;
\.
COPY adit.floor_plans (site, world, rules, radius, margin, area, at) FROM stdin;
\.
COPY adit.floor_regions (site, world, region, area) FROM stdin;
\.
COPY adit.floor_ways (site, world, way, from_adit, from_place, to_adit, doorway, region, length, clearance, weight) FROM stdin;
\.
COPY adit.frames (site, frame, x, y, yaw) FROM stdin;
store	map	0	0	0
world	map	0	0	0
\.
COPY adit.history (site, id, at, who, why, table_name, key, column_name, old, new, undone, change_set) FROM stdin;
store	1	2026-11-27T13:11:19.540Z	cli	he asked	customers	Bruno	club	0	1	\N	1
\.
COPY adit.hours (site, name, days, opens, closes) FROM stdin;
\.
COPY adit.journal (site, world, mission, entry, "time", event, state, next, action, rule, table_row, file, line, x, y, heading, true_x, true_y, true_heading, detail) FROM stdin;
world	flat	1	1	0	planned	\N	\N	\N	\N	\N	\N	\N	0.9251274861878052	6.127729669247381	56.54904854501857	0.9251274861878052	6.127729669247381	56.54904854501857	{"points":[[0.9251274861878052,6.127729669247381],[2.223112627863885,5.871863529086114],[2.897908478975297,5.263449341058732],[7.665787637233735,5.289833143353463],[7.810166865587235,5.434212356805802],[9.529842021726523,8.811309618426167]],"length":10.993410690348158,"off_network":false}
world	flat	1	2	0.05	state	hold	decide	none	hold	5	rules/navigation/execution.rhai	39	0.9251274861878052	6.127729669247381	56.54904854501857	0.9251274861878052	6.127729669247381	56.54904854501857	{"mode":"automatic","state":"hold","has_goal":true,"distance":1.3229636841927663,"is_falling":false,"heading_error":1.1815973080114013,"off_line":1.3044931675704887,"free":1.3229636841927663,"echo":1.3229636841927663,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":false,"is_changing":false,"has_room":true,"is_scan_complete":false,"scans":0.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":0.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.01,"sigma_heading":0.008726646259971648,"has_walls":true,"unexplained":0.0,"contradicted":0.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":0.05,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	3	0.1	state	decide	wait	none	decide	2	rules/navigation/execution.rhai	78	0.9251274861878052	6.127729669247381	56.54904854501857	0.9251274861878052	6.127729669247381	56.54904854501857	{"mode":"automatic","state":"decide","has_goal":true,"distance":1.3229636841927663,"is_falling":false,"heading_error":1.1815973080114013,"off_line":1.3044931675704887,"free":1.3229636841927663,"echo":1.3229636841927663,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":false,"is_changing":false,"has_room":true,"is_scan_complete":false,"scans":0.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":0.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.01,"sigma_heading":0.008726646259971648,"has_walls":true,"unexplained":0.0,"contradicted":0.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":0.1,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	4	6.1000000000000005	set estimated position	\N	\N	\N	\N	\N	\N	\N	0.9257233920954756	6.128322921137967	56.49882302884295	0.9251274861878052	6.127729669247381	56.54904854501857	{"pose":[0.9257233920954756,6.128322921137967,56.49882302884295]}
world	flat	1	5	6.1000000000000005	state	wait	decide	none	wait	1	rules/navigation/execution.rhai	125	0.9257233920954756	6.128322921137967	56.49882302884295	0.9251274861878052	6.127729669247381	56.54904854501857	{"mode":"automatic","state":"wait","has_goal":true,"distance":1.3224939504055748,"is_falling":false,"heading_error":1.181247969776651,"off_line":1.3041459234305919,"free":1.3224939504055748,"echo":1.3224939504055748,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":false,"is_changing":false,"has_room":true,"is_scan_complete":true,"scans":1.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":1.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.006736971390500563,"sigma_heading":0.0024024348405738386,"has_walls":true,"unexplained":0.016666666666666666,"contradicted":1.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":6.1000000000000005,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	6	6.15	state	decide	turn	none	decide	14	rules/navigation/execution.rhai	90	0.9257233920954756	6.128322921137967	56.49882302884295	0.9251274861878052	6.127729669247381	56.54904854501857	{"mode":"automatic","state":"decide","has_goal":true,"distance":1.3224939504055748,"is_falling":false,"heading_error":1.181247969776651,"off_line":1.3041459234305919,"free":1.3224939504055748,"echo":1.3224939504055748,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":false,"is_changing":false,"has_room":true,"is_scan_complete":true,"scans":1.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":1.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.006736971390500563,"sigma_heading":0.0024024348405738386,"has_walls":true,"unexplained":0.016666666666666666,"contradicted":1.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":6.15,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	7	6.95	state	turn	wait	none	turn	4	rules/navigation/execution.rhai	101	0.9257233920954756	6.128322921137967	-11.181700197756582	0.9251274861878052	6.127729669247381	-11.1314746815806	{"mode":"automatic","state":"turn","has_goal":true,"distance":1.3224939504055748,"is_falling":false,"heading_error":6.716849298982197e-15,"off_line":1.3041459234305919,"free":1.3224939504055748,"echo":1.3224939504055748,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":false,"is_changing":false,"has_room":true,"is_scan_complete":false,"scans":1.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":1.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.006736971390500563,"sigma_heading":0.0024024348405738386,"has_walls":true,"unexplained":0.016666666666666666,"contradicted":1.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":6.95,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	8	12.950000000000001	set estimated position	\N	\N	\N	\N	\N	\N	\N	0.9269066750005667	6.129626077600503	-11.226790974741329	0.9251274861878052	6.127729669247381	-11.1314746815806	{"pose":[0.9269066750005667,6.129626077600503,-11.226790974741329]}
world	flat	1	9	12.950000000000001	state	wait	decide	none	wait	1	rules/navigation/execution.rhai	125	0.9269066750005667	6.129626077600503	-11.226790974741329	0.9251274861878052	6.127729669247381	-11.1314746815806	{"mode":"automatic","state":"wait","has_goal":true,"distance":1.3215866992577276,"is_falling":false,"heading_error":0.0003539812913322393,"off_line":1.3035007155458291,"free":1.3215866992577276,"echo":1.3215866992577276,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":false,"is_changing":false,"has_room":true,"is_scan_complete":true,"scans":2.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":2.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.00511340368496946,"sigma_heading":0.0017453292519943296,"has_walls":true,"unexplained":0.008333333333333333,"contradicted":1.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":12.950000000000001,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	10	13	state	decide	move	none	decide	15	rules/navigation/execution.rhai	91	0.9269066750005667	6.129626077600503	-11.226790974741329	0.9251274861878052	6.127729669247381	-11.1314746815806	{"mode":"automatic","state":"decide","has_goal":true,"distance":1.3215866992577276,"is_falling":false,"heading_error":0.0003539812913322393,"off_line":1.3035007155458291,"free":1.3215866992577276,"echo":1.3215866992577276,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":false,"is_changing":false,"has_room":true,"is_scan_complete":true,"scans":2.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":2.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.00511340368496946,"sigma_heading":0.0017453292519943296,"has_walls":true,"unexplained":0.008333333333333333,"contradicted":1.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":13.0,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	11	15.5	state	move	hold	none	move	3	rules/navigation/execution.rhai	111	2.166665681436294	5.879264982166645	-11.668676303596762	2.1514633254213273	5.864913521624915	-12.630999465408921	{"mode":"automatic","state":"move","has_goal":true,"distance":0.05693012619608885,"is_falling":true,"heading_error":0.0732783335490701,"off_line":0.0037501143337711983,"free":0.05693012619608885,"echo":0.05693012619608885,"is_obstacle_moving":false,"is_contact":false,"back_offs":0.0,"is_busy":true,"is_changing":false,"has_room":true,"is_scan_complete":false,"scans":2.0,"left":null,"right":null,"detours_here":0.0,"closed_here":0.0,"waits":2.0,"has_way":true,"is_shut":false,"retries":0.0,"sigma":0.026729313367997033,"sigma_heading":0.011454477507365245,"has_walls":true,"unexplained":0.008333333333333333,"contradicted":1.0,"is_matched":false,"is_searched":false,"searches":0.0,"is_aside":false,"seeks":0.0,"is_last":false,"time":15.5,"goal_tolerance":0.08,"turning_resolution":0.03490658503988659,"highway_half_width":0.1,"look_ahead":2.5,"most_waits":4.0,"most_detours":4.0,"most_reports":8.0,"most_retries":2.0,"most_back_offs":3.0,"no_way_after":180.0,"sure":0.06,"sure_heading":0.08726646259971647,"most_unexplained":0.75,"most_contradicted":5.0,"most_searches":6.0,"most_seeks":3.0}
world	flat	1	12	15.5	reached	\N	\N	\N	\N	\N	\N	\N	2.166665681436294	5.879264982166645	-11.668676303596762	2.1514633254213273	5.864913521624915	-12.630999465408921	{"at":[2.223112627863885,5.871863529086114]}
\.
COPY adit.laid (site, name, what, kind, outline, properties, until, who, why, at) FROM stdin;
\.
COPY adit.learned_buildings (site, world, learned, rules, seed, radius, start_x, start_y, length, seconds, at) FROM stdin;
\.
COPY adit.learned_places (site, world, place, x, y) FROM stdin;
\.
COPY adit.learned_unseen (site, world, box, x0, y0, x1, y1) FROM stdin;
\.
COPY adit.learned_walls (site, world, wall, x0, y0, x1, y1) FROM stdin;
\.
COPY adit.loads (site, robot, load, height, width, carried) FROM stdin;
\.
COPY adit.log (site, entry, generation, owner, fence, at, changes) FROM stdin;
store	1	2		0	2026-11-27 13:11:57.509348+00	\N
world	1	1		0	2026-11-27 13:11:58.077642+00	\N
\.
COPY adit.measures (site, measure, unit) FROM stdin;
store	joules	J
store	seconds	s
world	joules	J
world	seconds	s
\.
COPY adit.missions (site, world, mission, seed, rules, start_x, start_y, goal_x, goal_y, obstacles, ending, length, optimum, seconds, at, robot) FROM stdin;
world	flat	1	17820962098460588588	navigation\nworld/rules	0.9251274861878052	6.127729669247381	9.529842021726523	8.811309618426167	2	arrived	10.89267158060541	10.802585798816231	115.85000000000001	2026-11-27T13:11:34Z	robot
\.
COPY adit.object_changes (site, cell, revision, object, task, how) FROM stdin;
\.
COPY adit.own_objects (site, kind, name, of_table, sql) FROM stdin;
store	table	customers	customers	CREATE TABLE "customers" ("customer" TEXT, "country" TEXT, "since" INTEGER, "club" BOOLEAN, PRIMARY KEY ("customer"))
store	table	notes	notes	CREATE TABLE notes (id INTEGER PRIMARY KEY, text TEXT)
store	table	orders	orders	CREATE TABLE "orders" ("order" INTEGER, "customer" TEXT, "product" TEXT, "pieces" INTEGER, PRIMARY KEY ("order"))
store	table	products	products	CREATE TABLE "products" ("product" TEXT, "price" REAL, "grams" INTEGER, "stock" INTEGER, PRIMARY KEY ("product"))
store	table	zones	zones	CREATE TABLE "zones" ("country" TEXT, "express" BOOLEAN, "fee" INTEGER, PRIMARY KEY ("country", "express"))
store	trigger	adit_watch_delete_customers	customers	CREATE TRIGGER "adit_watch_delete_customers" AFTER DELETE ON "customers" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('customers', ''); END
store	trigger	adit_watch_delete_orders	orders	CREATE TRIGGER "adit_watch_delete_orders" AFTER DELETE ON "orders" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('orders', ''); END
store	trigger	adit_watch_delete_products	products	CREATE TRIGGER "adit_watch_delete_products" AFTER DELETE ON "products" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('products', ''); END
store	trigger	adit_watch_delete_zones	zones	CREATE TRIGGER "adit_watch_delete_zones" AFTER DELETE ON "zones" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('zones', ''); END
store	trigger	adit_watch_insert_customers	customers	CREATE TRIGGER "adit_watch_insert_customers" AFTER INSERT ON "customers" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('customers', ''); END
store	trigger	adit_watch_insert_orders	orders	CREATE TRIGGER "adit_watch_insert_orders" AFTER INSERT ON "orders" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('orders', ''); END
store	trigger	adit_watch_insert_products	products	CREATE TRIGGER "adit_watch_insert_products" AFTER INSERT ON "products" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('products', ''); END
store	trigger	adit_watch_insert_zones	zones	CREATE TRIGGER "adit_watch_insert_zones" AFTER INSERT ON "zones" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('zones', ''); END
store	trigger	adit_watch_update_customers	customers	CREATE TRIGGER "adit_watch_update_customers" AFTER UPDATE ON "customers" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('customers', ''); END
store	trigger	adit_watch_update_orders	orders	CREATE TRIGGER "adit_watch_update_orders" AFTER UPDATE ON "orders" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('orders', ''); END
store	trigger	adit_watch_update_products	products	CREATE TRIGGER "adit_watch_update_products" AFTER UPDATE ON "products" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('products', ''); END
store	trigger	adit_watch_update_zones	zones	CREATE TRIGGER "adit_watch_update_zones" AFTER UPDATE ON "zones" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('zones', ''); END
world	table	adits	adits	CREATE TABLE "adits" ("adit" REAL, "doorway" REAL, "region" REAL, "twin" REAL, "x" REAL, "y" REAL)
world	table	marks	marks	CREATE TABLE "marks" ("mark" INTEGER, "what" TEXT, "x" REAL, "y" REAL, "property" TEXT, "value" TEXT, PRIMARY KEY ("mark"))
world	table	navigation	navigation	CREATE TABLE "navigation" ("figure" TEXT, "value" REAL, "unit" TEXT, "meaning" TEXT, PRIMARY KEY ("figure"))
world	table	regions	regions	CREATE TABLE "regions" ("region" REAL, "area" REAL)
world	table	sensors	sensors	CREATE TABLE "sensors" ("figure" TEXT, "value" REAL, "unit" TEXT, "meaning" TEXT, PRIMARY KEY ("figure"))
world	table	solids	solids	CREATE TABLE "solids" ("solid" INTEGER, "outline" TEXT, PRIMARY KEY ("solid"))
world	table	vehicles	vehicles	CREATE TABLE "vehicles" ("robot" TEXT, "radius" REAL, "margin" REAL, PRIMARY KEY ("robot"))
world	table	walls	walls	CREATE TABLE "walls" ("wall" INTEGER, "x0" REAL, "y0" REAL, "x1" REAL, "y1" REAL, PRIMARY KEY ("wall"))
world	trigger	adit_watch_delete_marks	marks	CREATE TRIGGER "adit_watch_delete_marks" AFTER DELETE ON "marks" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('marks', ''); END
world	trigger	adit_watch_delete_navigation	navigation	CREATE TRIGGER "adit_watch_delete_navigation" AFTER DELETE ON "navigation" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('navigation', ''); END
world	trigger	adit_watch_delete_sensors	sensors	CREATE TRIGGER "adit_watch_delete_sensors" AFTER DELETE ON "sensors" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('sensors', ''); END
world	trigger	adit_watch_delete_solids	solids	CREATE TRIGGER "adit_watch_delete_solids" AFTER DELETE ON "solids" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('solids', ''); END
world	trigger	adit_watch_delete_vehicles	vehicles	CREATE TRIGGER "adit_watch_delete_vehicles" AFTER DELETE ON "vehicles" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('vehicles', ''); END
world	trigger	adit_watch_delete_walls	walls	CREATE TRIGGER "adit_watch_delete_walls" AFTER DELETE ON "walls" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('walls', ''); END
world	trigger	adit_watch_insert_marks	marks	CREATE TRIGGER "adit_watch_insert_marks" AFTER INSERT ON "marks" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('marks', ''); END
world	trigger	adit_watch_insert_navigation	navigation	CREATE TRIGGER "adit_watch_insert_navigation" AFTER INSERT ON "navigation" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('navigation', ''); END
world	trigger	adit_watch_insert_sensors	sensors	CREATE TRIGGER "adit_watch_insert_sensors" AFTER INSERT ON "sensors" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('sensors', ''); END
world	trigger	adit_watch_insert_solids	solids	CREATE TRIGGER "adit_watch_insert_solids" AFTER INSERT ON "solids" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('solids', ''); END
world	trigger	adit_watch_insert_vehicles	vehicles	CREATE TRIGGER "adit_watch_insert_vehicles" AFTER INSERT ON "vehicles" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('vehicles', ''); END
world	trigger	adit_watch_insert_walls	walls	CREATE TRIGGER "adit_watch_insert_walls" AFTER INSERT ON "walls" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('walls', ''); END
world	trigger	adit_watch_update_marks	marks	CREATE TRIGGER "adit_watch_update_marks" AFTER UPDATE ON "marks" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('marks', ''); END
world	trigger	adit_watch_update_navigation	navigation	CREATE TRIGGER "adit_watch_update_navigation" AFTER UPDATE ON "navigation" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('navigation', ''); END
world	trigger	adit_watch_update_sensors	sensors	CREATE TRIGGER "adit_watch_update_sensors" AFTER UPDATE ON "sensors" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('sensors', ''); END
world	trigger	adit_watch_update_solids	solids	CREATE TRIGGER "adit_watch_update_solids" AFTER UPDATE ON "solids" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('solids', ''); END
world	trigger	adit_watch_update_vehicles	vehicles	CREATE TRIGGER "adit_watch_update_vehicles" AFTER UPDATE ON "vehicles" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('vehicles', ''); END
world	trigger	adit_watch_update_walls	walls	CREATE TRIGGER "adit_watch_update_walls" AFTER UPDATE ON "walls" WHEN (SELECT NOT quiet FROM writer) BEGIN INSERT OR IGNORE INTO stale_marks VALUES ('walls', ''); END
\.
COPY adit.own_rows (site, table_name, key, "row") FROM stdin;
store	customers	[1]	[1,"Ada","UK",2019,1]
store	customers	[2]	[2,"Bruno","DE",2024,1]
store	customers	[3]	[3,"Chiyo","JP",2021,1]
store	customers	[4]	[4,"Dara","DE",2025,null]
store	gpkg_contents	[1]	[1,"map_rooms","features","rooms","rooms of all layers, with what rules say","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
store	gpkg_contents	[2]	[2,"map_spaces","features","spaces","spaces as people see them","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
store	gpkg_contents	[3]	[3,"map_doorways","features","doorways","openings between spaces","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
store	gpkg_contents	[4]	[4,"map_areas","features","areas","areas of the map, and those laid over it","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
store	gpkg_contents	[5]	[5,"map_routes","features","routes","the routes that are kept","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
store	gpkg_contents	[6]	[6,"drawn","features","drawn","areas and obstacles laid over the map: draw here","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
store	gpkg_geometry_columns	[1]	[1,"drawn","geom","POLYGON",-1,0,0]
store	gpkg_geometry_columns	[2]	[2,"map_areas","geom","POLYGON",-1,0,0]
store	gpkg_geometry_columns	[3]	[3,"map_doorways","geom","LINESTRING",-1,0,0]
store	gpkg_geometry_columns	[4]	[4,"map_rooms","geom","POLYGON",-1,0,0]
store	gpkg_geometry_columns	[5]	[5,"map_routes","geom","LINESTRING",-1,0,0]
store	gpkg_geometry_columns	[6]	[6,"map_spaces","geom","POLYGON",-1,0,0]
store	gpkg_spatial_ref_sys	[-1]	[-1,"Undefined Cartesian SRS",-1,"NONE",-1,"undefined","metres of the map"]
store	gpkg_spatial_ref_sys	[0]	[0,"Undefined geographic SRS",0,"NONE",0,"undefined","undefined geographic coordinate reference system"]
store	gpkg_spatial_ref_sys	[4326]	[4326,"WGS 84 geodetic",4326,"EPSG",4326,"GEOGCS[\\"WGS 84\\",DATUM[\\"WGS_1984\\",SPHEROID[\\"WGS 84\\",6378137,298.257223563,AUTHORITY[\\"EPSG\\",\\"7030\\"]],AUTHORITY[\\"EPSG\\",\\"6326\\"]],PRIMEM[\\"Greenwich\\",0,AUTHORITY[\\"EPSG\\",\\"8901\\"]],UNIT[\\"degree\\",0.0174532925199433,AUTHORITY[\\"EPSG\\",\\"9122\\"]],AUTHORITY[\\"EPSG\\",\\"4326\\"]]","longitude and latitude"]
store	notes	[1]	[1,1,"Grüße"]
store	notes	[2]	[2,2,null]
store	orders	[1]	[1,1,"Ada","kettle",1]
store	orders	[2]	[2,2,"Bruno","tea",12]
store	orders	[3]	[3,3,"Chiyo","cup",6]
store	orders	[4]	[4,4,"Dara","kettle",2]
store	orders	[5]	[5,5,"Ada","tea",3]
store	products	[1]	[1,"kettle",39.9,1200,14]
store	products	[2]	[2,"cup",6.5,250,0]
store	products	[3]	[3,"tea",4.2,100,230]
store	zones	[1]	[1,"UK",1,19]
store	zones	[2]	[2,"UK",0,7]
store	zones	[3]	[3,"DE",1,12]
store	zones	[4]	[4,"DE",0,4]
store	zones	[5]	[5,"JP",1,38]
store	zones	[6]	[6,"JP",0,21]
world	adits	[1]	[1,0.0,0.0,1.0,1.0,2.499999999999999,5.35]
world	adits	[2]	[2,1.0,0.0,0.0,0.0,2.499999999999999,5.85]
world	adits	[3]	[3,2.0,1.0,2.0,3.0,1.9999999999999991,3.75]
world	adits	[4]	[4,3.0,1.0,1.0,2.0,1.9999999999999991,4.25]
world	adits	[5]	[5,4.0,2.0,1.0,5.0,6.499999999999999,4.25]
world	adits	[6]	[6,5.0,2.0,3.0,4.0,6.499999999999999,3.75]
world	adits	[7]	[7,6.0,3.0,4.0,7.0,10.0,3.75]
world	adits	[8]	[8,7.0,3.0,1.0,6.0,10.0,4.25]
world	adits	[9]	[9,8.0,4.0,1.0,9.0,8.049999997019768,5.35]
world	adits	[10]	[10,9.0,4.0,7.0,8.0,8.049999997019768,5.85]
world	adits	[11]	[11,10.0,5.0,3.0,11.0,8.75,1.7000000029802314]
world	adits	[12]	[12,11.0,5.0,4.0,10.0,9.25,1.7000000029802314]
world	adits	[13]	[13,12.0,6.0,7.0,13.0,9.75,7.425000499188899]
world	adits	[14]	[14,13.0,6.0,5.0,12.0,10.25,7.425000499188899]
world	adits	[15]	[15,14.0,7.0,8.0,15.0,9.75,7.6749995008111]
world	adits	[16]	[16,15.0,7.0,5.0,14.0,10.25,7.6749995008111]
world	adits	[17]	[17,16.0,8.0,6.0,17.0,8.700000002980232,8.25]
world	adits	[18]	[18,17.0,8.0,8.0,16.0,8.700000002980232,7.75]
world	adits	[19]	[19,18.0,9.0,9.0,19.0,6.249999999999999,7.75]
world	adits	[20]	[20,19.0,9.0,6.0,18.0,6.249999999999999,8.25]
world	adits	[21]	[21,20.0,10.0,8.0,21.0,8.825000502169132,7.8500000000000005]
world	adits	[22]	[22,21.0,10.0,7.0,20.0,8.825000502169132,7.3500000000000005]
world	adits	[23]	[23,22.0,11.0,7.0,23.0,6.249999999999999,7.35]
world	adits	[24]	[24,23.0,11.0,9.0,22.0,6.249999999999999,7.85]
world	gpkg_contents	[1]	[1,"map_rooms","features","rooms","rooms of all layers, with what rules say","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
world	gpkg_contents	[2]	[2,"map_spaces","features","spaces","spaces as people see them","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
world	gpkg_contents	[3]	[3,"map_doorways","features","doorways","openings between spaces","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
world	gpkg_contents	[4]	[4,"map_areas","features","areas","areas of the map, and those laid over it","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
world	gpkg_contents	[5]	[5,"map_routes","features","routes","the routes that are kept","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
world	gpkg_contents	[6]	[6,"drawn","features","drawn","areas and obstacles laid over the map: draw here","2026-11-24T00:00:00.000Z",null,null,null,null,-1]
world	gpkg_geometry_columns	[1]	[1,"drawn","geom","POLYGON",-1,0,0]
world	gpkg_geometry_columns	[2]	[2,"map_areas","geom","POLYGON",-1,0,0]
world	gpkg_geometry_columns	[3]	[3,"map_doorways","geom","LINESTRING",-1,0,0]
world	gpkg_geometry_columns	[4]	[4,"map_rooms","geom","POLYGON",-1,0,0]
world	gpkg_geometry_columns	[5]	[5,"map_routes","geom","LINESTRING",-1,0,0]
world	gpkg_geometry_columns	[6]	[6,"map_spaces","geom","POLYGON",-1,0,0]
world	gpkg_spatial_ref_sys	[-1]	[-1,"Undefined Cartesian SRS",-1,"NONE",-1,"undefined","metres of the map"]
world	gpkg_spatial_ref_sys	[0]	[0,"Undefined geographic SRS",0,"NONE",0,"undefined","undefined geographic coordinate reference system"]
world	navigation	[51]	[51,"patience",3600.0,"s","After so long a mission is given up."]
world	gpkg_spatial_ref_sys	[4326]	[4326,"WGS 84 geodetic",4326,"EPSG",4326,"GEOGCS[\\"WGS 84\\",DATUM[\\"WGS_1984\\",SPHEROID[\\"WGS 84\\",6378137,298.257223563,AUTHORITY[\\"EPSG\\",\\"7030\\"]],AUTHORITY[\\"EPSG\\",\\"6326\\"]],PRIMEM[\\"Greenwich\\",0,AUTHORITY[\\"EPSG\\",\\"8901\\"]],UNIT[\\"degree\\",0.0174532925199433,AUTHORITY[\\"EPSG\\",\\"9122\\"]],AUTHORITY[\\"EPSG\\",\\"4326\\"]]","longitude and latitude"]
world	navigation	[1]	[1,"goal_tolerance",0.08,"m","So near to a goal point counts as there."]
world	navigation	[2]	[2,"turning_resolution",2.0,"°","The robot does not turn by less."]
world	navigation	[3]	[3,"highway_half_width",0.1,"m","So far beside the line to its goal point the robot may be."]
world	navigation	[4]	[4,"highway_clearance",0.02,"m","What is kept free on either side of the robot while it goes straight."]
world	navigation	[5]	[5,"look_ahead",2.5,"m","Obstacles on the way count from so near on."]
world	navigation	[6]	[6,"stride",3.0,"m","The robot goes no farther without a look around."]
world	navigation	[7]	[7,"speed",0.5,"m/s","How fast the robot goes."]
world	navigation	[8]	[8,"stride_to_room",15.0,"","On a site's route it goes no farther without a look around than so many times the room beside it."]
world	navigation	[9]	[9,"scan_readings",120.0,"","Readings of the sonar that make a whole scan."]
world	navigation	[10]	[10,"look",2.0,"s","A look around takes so long at the least, however fast the sensors are: things move meanwhile."]
world	navigation	[11]	[11,"pace",1.0,"s","What is seen is taken into the model no more often, however fast the sensors are: what moves is told by that it has."]
world	navigation	[12]	[12,"part_readings",40.0,"","Readings after which the model is updated on the way."]
world	navigation	[13]	[13,"echoes",2.0,"","So many raw echoes are in the way before what they hit is: one may be false."]
world	navigation	[14]	[14,"falling",0.05,"m","The goal point is farther away than it was from so much on."]
world	navigation	[15]	[15,"detour_clearance",0.05,"m","What a detour keeps free on either side of the robot at the least."]
world	navigation	[16]	[16,"room",0.1,"m","What a detour keeps free where there is room."]
world	navigation	[17]	[17,"room_worth",1.3,"","A way with room may be longer, or harder, than one without by this factor."]
world	navigation	[18]	[18,"beside",0.02,"m","A site is asked first for ways that leave so much more beside the robot than it needs."]
world	navigation	[19]	[19,"corner",0.05,"m","A surface that was seen to end may go on unseen, between two beams, for so much at the most."]
world	navigation	[20]	[20,"squeeze",0.025,"m","What is kept free on either side where there is no other way: a little more than on the highway."]
world	navigation	[21]	[21,"most_squeezes",4.0,"","So many times on a mission the robot squeezes through."]
world	navigation	[22]	[22,"detour_reach",2.0,"m","A detour leaves the rectangle about its ends by at most so much."]
world	navigation	[23]	[23,"grain",0.04,"m","The grain of the search for detours."]
world	navigation	[24]	[24,"back_off",0.15,"m","How far the robot withdraws from what it touched."]
world	navigation	[25]	[25,"change_room",0.15,"m","What is kept free on either side of the robot where it changes its shape, if there is such a place."]
world	navigation	[26]	[26,"change_reach",1.5,"m","So far before or behind the place that a route says the robot changes its shape, to have room."]
world	navigation	[27]	[27,"felt",90.0,"s","What was touched is in the way for so long."]
world	navigation	[28]	[28,"least_confidence",2.0,"","Surfaces of less confidence close no way for good."]
world	navigation	[29]	[29,"firm_confidence",3.0,"","Surfaces of this confidence stand, even if they are part of what seems to move."]
world	navigation	[30]	[30,"memory",6.0,"m","Surfaces farther away than this are remembered where the local model drops them."]
world	navigation	[31]	[31,"same_spot",0.5,"m","Blocked within so far of where it was blocked before counts as the same spot."]
world	navigation	[32]	[32,"most_waits",4.0,"","Waits for a moving obstacle at one spot."]
world	navigation	[33]	[33,"most_detours",4.0,"","Detours from one spot before the way counts as closed."]
world	navigation	[34]	[34,"most_closed",2.0,"","Ways closed at one spot before a path is looked for off the network, through what is known to be free."]
world	navigation	[35]	[35,"most_reports",8.0,"","Ways that routes lead and that are reported closed at one spot before everything is looked at anew."]
world	navigation	[36]	[36,"heed",0.5,"s","So often a robot on a site's route asks whether others changed what ways there are."]
world	navigation	[37]	[37,"near_robot",0.3,"m","What is seen so near to where another robot says that its rim is, is that robot."]
world	navigation	[38]	[38,"pause",60.0,"s","Of several robots who found no way waits so long before it sets out for elsewhere."]
world	navigation	[39]	[39,"reported",3600.0,"s","What the robot tells a site of which rooms are cut holds so long."]
world	navigation	[40]	[40,"most_retries",2.0,"","Times that everything is looked at anew before there is no way."]
world	navigation	[41]	[41,"give_way",1.5,"m","Before it begins anew the robot goes back on its own track, up to so far, to give way."]
world	navigation	[42]	[42,"no_way_after",180.0,"s","There may be a way again for so long: things that move come to rest."]
world	navigation	[43]	[43,"most_back_offs",3.0,"","Times that the robot withdraws from touches before it looks around."]
world	navigation	[44]	[44,"sure",0.06,"m","The position is sure while its standard deviation is no larger."]
world	navigation	[45]	[45,"sure_heading",5.0,"°","The heading is sure while its standard deviation is no larger."]
world	navigation	[46]	[46,"most_unexplained",0.75,"","Where a larger share of a scan's beams ends before the known walls, the robot is elsewhere."]
world	navigation	[47]	[47,"most_contradicted",5.0,"","Where more beams side by side run through known walls, the robot is elsewhere."]
world	navigation	[48]	[48,"most_searches",6.0,"","So many times on a mission the robot looks for itself over the whole building before it is lost."]
world	navigation	[49]	[49,"most_seeks",3.0,"","So many times on a mission it goes where known walls tell where it is."]
world	navigation	[50]	[50,"off_facing",1.0,"°","A robot that is longer than wide turns back to its facing where it is off that by more."]
world	regions	[1]	[1,0.0,24.200000000000003]
world	regions	[2]	[2,1.0,22.399999999999995]
world	regions	[3]	[3,2.0,18.0]
world	regions	[4]	[4,3.0,18.0]
world	regions	[5]	[5,4.0,18.0]
world	regions	[6]	[6,5.0,17.6]
world	regions	[7]	[7,6.0,9.0]
world	regions	[8]	[8,7.0,9.0]
world	regions	[9]	[9,8.0,1.0400000000000007]
world	regions	[10]	[10,9.0,0.6000000000000005]
world	regions	[11]	[11,10.0,0.16000000000000028]
world	sensors	[1]	[1,"directions",120.0,"","Into how many directions it measures, all around."]
world	sensors	[2]	[2,"at_once",1.0,"","In how many of them at once, one beside the other: 1 for a sonar that turns, all of them for a lidar or a ring."]
world	sensors	[3]	[3,"period",0.05,"s","Time from these readings to the next; sound needs 0.047 s for 8 m and back."]
world	sensors	[4]	[4,"range",8.0,"m","How far away something is measured."]
world	sensors	[5]	[5,"noise",0.01,"","Standard deviation of a reading, as a share of it."]
world	sensors	[6]	[6,"missed",0.02,"","Share of the readings without an echo where there is one."]
world	sensors	[7]	[7,"false_echoes",0.01,"","Share of the readings with an echo from anywhere."]
world	sensors	[8]	[8,"skirt",1.0,"","Whether a skirt feels what the robot touches."]
world	sensors	[9]	[9,"turning_speed",90.0,"°/s","How fast it turns."]
world	sensors	[10]	[10,"distance_noise",0.02,"","Standard deviation of the distance that the wheels count, as a share of it."]
world	sensors	[11]	[11,"heading_noise",1.0,"°/√m","Standard deviation of the heading after one metre; it grows with the root of the metres."]
world	sensors	[12]	[12,"heading_bias",0.05,"°/m","By how much the heading drifts to the left unnoticed."]
world	vehicles	[1]	[1,"robot",0.25,0.0]
world	walls	[1]	[1,1,0.0,0.0,12.0,0.0]
world	walls	[2]	[2,2,12.0,0.0,14.0,2.0]
world	walls	[3]	[3,3,14.0,2.0,14.0,10.0]
world	walls	[4]	[4,4,14.0,10.0,0.0,10.0]
world	walls	[5]	[5,5,0.0,10.0,0.0,0.0]
world	walls	[6]	[6,6,0.0,4.0,1.5,4.0]
world	walls	[7]	[7,7,2.5,4.0,6.0,4.0]
world	walls	[8]	[8,8,7.0,4.0,9.5,4.0]
world	walls	[9]	[9,9,10.5,4.0,14.0,4.0]
world	walls	[10]	[10,10,4.5,0.0,4.5,4.0]
world	walls	[11]	[11,11,9.0,0.0,9.0,1.2]
world	walls	[12]	[12,12,9.0,2.2,9.0,4.0]
world	walls	[13]	[13,13,0.0,5.6,2.0,5.6]
world	walls	[14]	[14,14,3.0,5.6,7.5,5.6]
world	walls	[15]	[15,15,8.6,5.6,14.0,5.6]
world	walls	[16]	[16,16,5.5,5.6,5.5,10.0]
world	walls	[17]	[17,17,10.0,5.6,10.0,7.0]
world	walls	[18]	[18,18,10.0,8.0,10.0,10.0]
world	walls	[19]	[19,19,7.0,7.6,7.4,7.6]
world	walls	[20]	[20,20,7.4,7.6,7.4,8.0]
world	walls	[21]	[21,21,7.4,8.0,7.0,8.0]
world	walls	[22]	[22,22,7.0,8.0,7.0,7.6]
\.
COPY adit.places (site, place, x, y) FROM stdin;
world	bath	12	8
world	bed	1.5	1.5
world	desk	6.5	1.5
world	hall	12.5	4.8
world	kitchen	2.5	8
world	living room	8.8	8.8
world	store	11.5	2
\.
COPY adit.prime_area_strips (site, area, x_first, x_last, y_first, y_last, open, open_rule, open_witness) FROM stdin;
\.
COPY adit.robots (site, robot, state, action, height, width, hardness, "position", length, speed, power) FROM stdin;
\.
COPY adit.rooms (site, room, name, robot, state, x0, y0, x1, y1, height, width, hardness, action, hardness_rule, hardness_witness, action_rule, action_witness, passable, passable_rule, passable_witness, facing, outline, radius, space, berth, berth_cost, measures) FROM stdin;
\.
COPY adit.rules (site, rule, name, version, file, line) FROM stdin;
store	1	what the goods of an order cost and weigh	6d8612fa	/work/main/target/debug/built-examples/.tmpg087dS/rules/orders.rhai	8
store	2	discount	c9fda345	/work/main/target/debug/built-examples/.tmpg087dS/rules/orders.rhai	17
store	3	what it costs to send an order	f84282e5	/work/main/target/debug/built-examples/.tmpg087dS/rules/orders.rhai	26
store	4	what an order costs	178a2f85	/work/main/target/debug/built-examples/.tmpg087dS/rules/orders.rhai	31
store	5	an order goes out when all of it is there	c6d721ad	/work/main/target/debug/built-examples/.tmpg087dS/rules/orders.rhai	35
store	6	property ORDERS.express	26e94548	/work/main/target/debug/built-examples/.tmpg087dS/rules/orders.rhai	6
world	1	a doorway is called by its number	7bcc756a	rules/navigation/doorways.rhai	3
world	2	what the tolerances say	553f19ed	rules/navigation/execution.rhai	4
world	3	what holds on the routes of a site	26e8f5ed	rules/navigation/execution.rhai	21
world	4	hold	fa411b12	rules/navigation/execution.rhai	31
world	5	how sure the robot is of where it is	94826047	rules/navigation/execution.rhai	45
world	6	what is to be done about where it is	b8a59120	rules/navigation/execution.rhai	57
world	7	decide	689daeb7	rules/navigation/execution.rhai	72
world	8	turn	38d3e6b3	rules/navigation/execution.rhai	94
world	9	move	8d06761b	rules/navigation/execution.rhai	104
world	10	wait	1ba3d43d	rules/navigation/execution.rhai	121
world	11	how patient the robot is	1da28d30	rules/navigation/execution.rhai	129
world	12	blocked	c9036b87	rules/navigation/execution.rhai	141
world	13	what is known of an opening	a4199866	rules/navigation/openings.rhai	4
world	14	which opening is next	8bfe152b	rules/navigation/openings.rhai	15
world	15	a doorway that a robot found blocked is closed for an hour	b32f4cfd	rules/navigation/reports.rhai	5
world	16	what may be moving	f69e75f7	rules/navigation/segments.rhai	6
world	17	confidence	8d098d38	rules/navigation/segments.rhai	10
world	18	what stays	516e5b03	rules/navigation/segments.rhai	27
world	19	what the position is corrected by	f13db49b	rules/navigation/segments.rhai	35
world	20	a way weighs its length	170a1805	rules/navigation/ways.rhai	3
world	21	a robot drives along a way	fcb92aa3	rules/navigation/ways.rhai	7
world	22	a way that is cut by what was seen is not taken	1c4a9995	rules/navigation/ways.rhai	11
world	23	a closed doorway is not passed	0c6eab6f	rules/navigation/ways.rhai	15
world	24	a way that was found blocked weighs more each time	38f4dc84	rules/navigation/ways.rhai	19
world	25	a door that squeaks weighs more	2f943309	rules/navigation/ways.rhai	24
world	26	property DOORWAYS.blocked	6a05898a	rules/navigation/reports.rhai	3
\.
COPY adit.saved_queries (site, name, query, who, at) FROM stdin;
\.
COPY adit.sequences (site, name, last) FROM stdin;
store	history	1
\.
COPY adit.site (site, key, value) FROM stdin;
store	basis	e3383c58e3c4e751
store	generation	2
store	name	shop
store	rooms	none
store	texts	7222185238581110634
world	basis	b859b65470bc5047
world	class.adits	planner
world	class.regions	planner
world	generation	1
world	layout	floor plan
world	name	world
world	planner.regions	4d61e9b22f4d067b372170479b4a8132
world	rooms	none
world	texts	18318788327987936448
\.
COPY adit.site_hours (site, name, days, opens, closes) FROM stdin;
\.
COPY adit.sites (site, entry, generation, worlds, owner, fence, ends) FROM stdin;
store	1	2	f	\N	0	\N
world	1	1	t	\N	0	\N
\.
COPY adit.spaces (site, space, called, name, kind, area, breadth, x, y, outline, closed) FROM stdin;
\.
COPY adit.stale_marks (site, table_name, key) FROM stdin;
\.
COPY adit.starts (site, name, robot, tree) FROM stdin;
\.
COPY adit.strategies (site, cell, revision, task, strategy, facts, rule, table_row, file, line) FROM stdin;
\.
COPY adit.strips (site, axis, strip, low, high) FROM stdin;
\.
COPY adit.subgoal_pairs (site, cell, subgoal1, subgoal2, kind, revision) FROM stdin;
\.
COPY adit.subgoals (site, cell, subgoal, configuration, object, tool_x, tool_y, tool_heading_rad, branch, made_task, removed_task, because) FROM stdin;
\.
COPY adit.tasks (site, cell, task, goal, configuration, found, reason, evaluations, solve_calls, reach_calls, length, path, at) FROM stdin;
\.
COPY adit.told (site, id, class, key, x, y, x0, y0, x1, y1, property, kind, value, until, who, why, at) FROM stdin;
\.
COPY adit.told_states (site, told, state) FROM stdin;
\.
COPY adit.traversals (site, id, mission, robot, state, distance, measured, measure, who, at) FROM stdin;
\.
COPY adit.tree_rows (site, tree, node, prev, from_room, door, hops, reach, leg, x, y, heading, distance, clearance, bend, walked) FROM stdin;
\.
COPY adit.tuning_cells (site, tuning, table_name, key, column_name, value) FROM stdin;
\.
COPY adit.version (one, version) FROM stdin;
1	21
\.
COPY adit.witnesses (site, witness, facts) FROM stdin;
store	1289592934033724349	{"zone":"ZONES 5"}
store	5056091989359768725	{"zone":"ZONES 1"}
store	7544477349256158821	{"zone":"ZONES 3"}
\.
ALTER TABLE ONLY adit.active_tunings
    ADD CONSTRAINT active_tunings_pkey PRIMARY KEY (site, tuning);
ALTER TABLE ONLY adit.area_outlines
    ADD CONSTRAINT area_outlines_pkey PRIMARY KEY (site, area);
ALTER TABLE ONLY adit.attachments
    ADD CONSTRAINT attachments_pkey PRIMARY KEY (site, told, key);
ALTER TABLE ONLY adit.cell_objects
    ADD CONSTRAINT cell_objects_pkey PRIMARY KEY (site, cell, object);
ALTER TABLE ONLY adit.cells
    ADD CONSTRAINT cells_pkey PRIMARY KEY (site, cell);
ALTER TABLE ONLY adit.changes
    ADD CONSTRAINT changes_pkey PRIMARY KEY (site, robot, from_state, to_state);
ALTER TABLE ONLY adit.course_steps
    ADD CONSTRAINT course_steps_pkey PRIMARY KEY (site, start, goal, robot, step);
ALTER TABLE ONLY adit.course_waypoints
    ADD CONSTRAINT course_waypoints_pkey PRIMARY KEY (site, start, goal, robot, waypoint);
ALTER TABLE ONLY adit.courses
    ADD CONSTRAINT courses_pkey PRIMARY KEY (site, start, goal, robot);
ALTER TABLE ONLY adit.derivations
    ADD CONSTRAINT derivations_pkey PRIMARY KEY (site, class, key, property);
ALTER TABLE ONLY adit.doors
    ADD CONSTRAINT doors_pkey PRIMARY KEY (site, door);
ALTER TABLE ONLY adit.doorways
    ADD CONSTRAINT doorways_pkey PRIMARY KEY (site, doorway);
ALTER TABLE ONLY adit.drawn
    ADD CONSTRAINT drawn_pkey PRIMARY KEY (site, fid);
ALTER TABLE ONLY adit.edges
    ADD CONSTRAINT edges_pkey PRIMARY KEY (site, cell, edge);
ALTER TABLE ONLY adit.endings
    ADD CONSTRAINT endings_pkey PRIMARY KEY (site, ending);
ALTER TABLE ONLY adit.ends
    ADD CONSTRAINT ends_pkey PRIMARY KEY (site, name);
ALTER TABLE ONLY adit.files
    ADD CONSTRAINT files_pkey PRIMARY KEY (site, path);
ALTER TABLE ONLY adit.floor_adits
    ADD CONSTRAINT floor_adits_pkey PRIMARY KEY (site, world, adit);
ALTER TABLE ONLY adit.floor_corners
    ADD CONSTRAINT floor_corners_pkey PRIMARY KEY (site, world, region, corner);
ALTER TABLE ONLY adit.floor_doorways
    ADD CONSTRAINT floor_doorways_pkey PRIMARY KEY (site, world, doorway);
ALTER TABLE ONLY adit.floor_places
    ADD CONSTRAINT floor_places_pkey PRIMARY KEY (site, world, place);
ALTER TABLE ONLY adit.floor_plans
    ADD CONSTRAINT floor_plans_pkey PRIMARY KEY (site, world);
ALTER TABLE ONLY adit.floor_regions
    ADD CONSTRAINT floor_regions_pkey PRIMARY KEY (site, world, region);
ALTER TABLE ONLY adit.floor_ways
    ADD CONSTRAINT floor_ways_pkey PRIMARY KEY (site, world, way);
ALTER TABLE ONLY adit.frames
    ADD CONSTRAINT frames_pkey PRIMARY KEY (site, frame);
ALTER TABLE ONLY adit.history
    ADD CONSTRAINT history_pkey PRIMARY KEY (site, id);
ALTER TABLE ONLY adit.hours
    ADD CONSTRAINT hours_pkey PRIMARY KEY (site, name, days, opens);
ALTER TABLE ONLY adit.journal
    ADD CONSTRAINT journal_pkey PRIMARY KEY (site, world, mission, entry);
ALTER TABLE ONLY adit.laid
    ADD CONSTRAINT laid_pkey PRIMARY KEY (site, name);
ALTER TABLE ONLY adit.learned_buildings
    ADD CONSTRAINT learned_buildings_pkey PRIMARY KEY (site, world);
ALTER TABLE ONLY adit.learned_places
    ADD CONSTRAINT learned_places_pkey PRIMARY KEY (site, world, place);
ALTER TABLE ONLY adit.learned_unseen
    ADD CONSTRAINT learned_unseen_pkey PRIMARY KEY (site, world, box);
ALTER TABLE ONLY adit.learned_walls
    ADD CONSTRAINT learned_walls_pkey PRIMARY KEY (site, world, wall);
ALTER TABLE ONLY adit.loads
    ADD CONSTRAINT loads_pkey PRIMARY KEY (site, robot, load);
ALTER TABLE ONLY adit.log
    ADD CONSTRAINT log_pkey PRIMARY KEY (site, entry);
ALTER TABLE ONLY adit.measures
    ADD CONSTRAINT measures_pkey PRIMARY KEY (site, measure);
ALTER TABLE ONLY adit.missions
    ADD CONSTRAINT missions_pkey PRIMARY KEY (site, world, mission);
ALTER TABLE ONLY adit.object_changes
    ADD CONSTRAINT object_changes_pkey PRIMARY KEY (site, cell, revision, object);
ALTER TABLE ONLY adit.own_objects
    ADD CONSTRAINT own_objects_pkey PRIMARY KEY (site, kind, name);
ALTER TABLE ONLY adit.own_rows
    ADD CONSTRAINT own_rows_pkey PRIMARY KEY (site, table_name, key);
ALTER TABLE ONLY adit.places
    ADD CONSTRAINT places_pkey PRIMARY KEY (site, place);
ALTER TABLE ONLY adit.prime_area_strips
    ADD CONSTRAINT prime_area_strips_pkey PRIMARY KEY (site, area);
ALTER TABLE ONLY adit.robots
    ADD CONSTRAINT robots_pkey PRIMARY KEY (site, robot, state);
ALTER TABLE ONLY adit.rooms
    ADD CONSTRAINT rooms_pkey PRIMARY KEY (site, room);
ALTER TABLE ONLY adit.rules
    ADD CONSTRAINT rules_pkey PRIMARY KEY (site, rule);
ALTER TABLE ONLY adit.saved_queries
    ADD CONSTRAINT saved_queries_pkey PRIMARY KEY (site, name);
ALTER TABLE ONLY adit.sequences
    ADD CONSTRAINT sequences_pkey PRIMARY KEY (site, name);
ALTER TABLE ONLY adit.site_hours
    ADD CONSTRAINT site_hours_pkey PRIMARY KEY (site, name, days, opens);
ALTER TABLE ONLY adit.site
    ADD CONSTRAINT site_pkey PRIMARY KEY (site, key);
ALTER TABLE ONLY adit.sites
    ADD CONSTRAINT sites_pkey PRIMARY KEY (site);
ALTER TABLE ONLY adit.spaces
    ADD CONSTRAINT spaces_pkey PRIMARY KEY (site, space);
ALTER TABLE ONLY adit.stale_marks
    ADD CONSTRAINT stale_marks_pkey PRIMARY KEY (site, table_name, key);
ALTER TABLE ONLY adit.starts
    ADD CONSTRAINT starts_pkey PRIMARY KEY (site, name, robot);
ALTER TABLE ONLY adit.strategies
    ADD CONSTRAINT strategies_pkey PRIMARY KEY (site, cell, revision);
ALTER TABLE ONLY adit.strips
    ADD CONSTRAINT strips_pkey PRIMARY KEY (site, axis, strip);
ALTER TABLE ONLY adit.subgoal_pairs
    ADD CONSTRAINT subgoal_pairs_pkey PRIMARY KEY (site, cell, subgoal1, subgoal2, kind);
ALTER TABLE ONLY adit.subgoals
    ADD CONSTRAINT subgoals_pkey PRIMARY KEY (site, cell, subgoal);
ALTER TABLE ONLY adit.tasks
    ADD CONSTRAINT tasks_pkey PRIMARY KEY (site, cell, task);
ALTER TABLE ONLY adit.told
    ADD CONSTRAINT told_pkey PRIMARY KEY (site, id);
ALTER TABLE ONLY adit.told_states
    ADD CONSTRAINT told_states_pkey PRIMARY KEY (site, told);
ALTER TABLE ONLY adit.traversals
    ADD CONSTRAINT traversals_pkey PRIMARY KEY (site, id);
ALTER TABLE ONLY adit.tree_rows
    ADD CONSTRAINT tree_rows_pkey PRIMARY KEY (site, tree, node);
ALTER TABLE ONLY adit.tuning_cells
    ADD CONSTRAINT tuning_cells_pkey PRIMARY KEY (site, tuning, table_name, key, column_name);
ALTER TABLE ONLY adit.version
    ADD CONSTRAINT version_pkey PRIMARY KEY (one);
ALTER TABLE ONLY adit.witnesses
    ADD CONSTRAINT witnesses_pkey PRIMARY KEY (site, witness);
CREATE INDEX doors_site_room1_idx ON adit.doors USING btree (site, room1);
CREATE INDEX doors_site_room2_idx ON adit.doors USING btree (site, room2);
CREATE INDEX doorways_site_space1_space2_idx ON adit.doorways USING btree (site, space1, space2);
CREATE INDEX drawn_site_name_idx ON adit.drawn USING btree (site, name);
CREATE INDEX history_site_change_set_idx ON adit.history USING btree (site, change_set);
CREATE INDEX learned_buildings_site_learned_idx ON adit.learned_buildings USING btree (site, learned);
CREATE INDEX rooms_site_name_idx ON adit.rooms USING btree (site, name);
CREATE INDEX traversals_site_robot_measure_mission_idx ON adit.traversals USING btree (site, robot, measure, mission);
GRANT USAGE ON SCHEMA adit TO reader;
GRANT SELECT ON TABLE adit.action_sequence TO reader;
GRANT SELECT ON TABLE adit.routes TO reader;
