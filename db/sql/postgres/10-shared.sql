-- Of all sites in one database of PostgreSQL. The tables of a site's database in SQLite follow, each with `site` before its key.
CREATE SCHEMA IF NOT EXISTS adit;

-- The version of the tables: that of SQLite's, and in two digits behind it the how manieth form of them here.
CREATE TABLE IF NOT EXISTS adit.version (
  one     bigint PRIMARY KEY CHECK (one = 1),
  version bigint NOT NULL
);

-- entry: the newest of the log. owner, fence, until: who may write, the how manieth owner that is, and until when.
CREATE TABLE IF NOT EXISTS adit.sites (
  site       text PRIMARY KEY,
  entry      bigint NOT NULL,
  generation bigint NOT NULL,
  worlds     boolean NOT NULL,
  owner      text,
  fence      bigint NOT NULL DEFAULT 0,
  until      timestamptz
);

-- What was changed, in order: rows by their keys, as JSON. NULL: the site was replaced.
CREATE TABLE IF NOT EXISTS adit.log (
  site       text NOT NULL,
  entry      bigint NOT NULL,
  generation bigint NOT NULL,
  owner      text NOT NULL,
  fence      bigint NOT NULL,
  at         timestamptz NOT NULL DEFAULT now(),
  changes    text,
  PRIMARY KEY (site, entry)
);

-- The site's files: settings, map, rules, tables.
CREATE TABLE IF NOT EXISTS adit.files (
  site  text NOT NULL,
  path  text NOT NULL,
  bytes bytea NOT NULL,
  PRIMARY KEY (site, path)
);

-- Tables, indexes, views and triggers of somebody's own in the site's database, in SQLite's words.
CREATE TABLE IF NOT EXISTS adit.own_objects (
  site     text NOT NULL,
  kind     text NOT NULL,
  name     text NOT NULL,
  of_table text NOT NULL,
  sql      text NOT NULL,
  PRIMARY KEY (site, kind, name)
);

-- Rows of these tables, each as a list in JSON, its key before its columns.
CREATE TABLE IF NOT EXISTS adit.own_rows (
  site       text NOT NULL,
  table_name text NOT NULL,
  key        text NOT NULL,
  row        text NOT NULL,
  PRIMARY KEY (site, table_name, key)
);

-- The last number that was given to a row of a table.
CREATE TABLE IF NOT EXISTS adit.sequences (
  site text NOT NULL,
  name text NOT NULL,
  last bigint NOT NULL,
  PRIMARY KEY (site, name)
);
