-- Facts that people and robots told. A fact is about an object by its name (`key`), or about what lies at a point
-- (x, y), since numbers of rooms and doors move: a door also has the segment (x0, y0, x1, y1) that it had when it was
-- told. A truth value is 0 or 1. `until` is in UTC; the newest fact that holds counts.
CREATE TABLE told (
  id       INTEGER PRIMARY KEY AUTOINCREMENT,
  class    TEXT NOT NULL CONSTRAINT "class must not be empty" CHECK (length(class) > 0),
  key      TEXT CONSTRAINT "key must not be empty" CHECK (length(key) > 0),
  x REAL CONSTRAINT "x must be finite" CHECK (x BETWEEN -1e300 AND 1e300),
  y REAL CONSTRAINT "y must be finite" CHECK (y BETWEEN -1e300 AND 1e300),
  x0 REAL, y0 REAL, x1 REAL, y1 REAL,
  property TEXT NOT NULL CONSTRAINT "property must not be empty" CHECK (length(property) > 0),
  kind     TEXT NOT NULL CONSTRAINT "kind must be number, text or truth" CHECK (kind IN ('number', 'text', 'truth')),
  value    ANY NOT NULL,
  until    TEXT CONSTRAINT "until must be a time in UTC, like 2026-11-21T18:00:00Z"
           CHECK (strftime('%Y-%m-%dT%H:%M:%SZ', until) IS until),
  who      TEXT NOT NULL DEFAULT '',
  why      TEXT NOT NULL DEFAULT '',
  at       TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  CONSTRAINT "a fact has a key or a point, not both" CHECK ((key IS NULL) = (x IS NOT NULL) AND (x IS NULL) = (y IS NULL)),
  CONSTRAINT "a segment has two ends" CHECK ((x0 IS NULL) = (y0 IS NULL) AND (x0 IS NULL) = (x1 IS NULL) AND (x0 IS NULL) = (y1 IS NULL)),
  CONSTRAINT "the value must be of the kind" CHECK (CASE kind WHEN 'text' THEN typeof(value) = 'text'
    WHEN 'truth' THEN typeof(value) = 'integer' AND value IN (0, 1) ELSE typeof(value) IN ('real', 'integer') END)
) STRICT;

-- What the last build made of each fact: the objects that it is about, and whether there is one.
CREATE TABLE attachments (
  told INTEGER NOT NULL,
  key  TEXT NOT NULL,
  PRIMARY KEY (told, key)
) STRICT, WITHOUT ROWID;

CREATE TABLE told_states (
  told  INTEGER PRIMARY KEY,
  state TEXT NOT NULL CHECK (state IN ('attached', 'lost', 'expired'))
) STRICT;

CREATE VIEW facts_told AS
SELECT t.id AS id, t.class AS class, coalesce(t.key, t.x || ',' || t.y) AS object, t.property AS property,
       CASE t.kind WHEN 'truth' THEN iif(t.value, 'true', 'false') ELSE t.value END AS value,
       t.until AS until, s.state AS state,
       (SELECT json_group_array(a.key) FROM attachments AS a WHERE a.told = t.id) AS objects,
       t.who AS who, t.why AS why, t.at AS at
FROM told AS t LEFT JOIN told_states AS s ON s.told = t.id;

CREATE TRIGGER stale_told_insert AFTER INSERT ON told WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('told', NEW.id);
END;
CREATE TRIGGER stale_told_update AFTER UPDATE ON told WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('told', NEW.id);
END;
CREATE TRIGGER stale_told_delete AFTER DELETE ON told WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('told', OLD.id);
END;
