-- Plans of worlds are routes of sites now: what `adit plan` kept goes, and a learned building is kept without a path.
DROP TABLE IF EXISTS step_rules;
DROP TABLE IF EXISTS step_facts;
DROP TABLE IF EXISTS path_steps;
DROP TABLE IF EXISTS corners;
DROP TABLE IF EXISTS junctions;
DROP TABLE IF EXISTS channels;
DROP TABLE IF EXISTS plans;
DROP TABLE IF EXISTS floor_waypoints;
ALTER TABLE floor_plans DROP COLUMN status;
ALTER TABLE floor_plans DROP COLUMN reason;
ALTER TABLE floor_plans DROP COLUMN length;
ALTER TABLE floor_plans DROP COLUMN weight;
