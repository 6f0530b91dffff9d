-- Bridges and named doors may be laid over the map, too: a door is drawn from post to post. The table is made anew, as for places.
CREATE TABLE laid_before AS SELECT * FROM laid;
DROP TABLE laid;
CREATE TABLE laid (
  name       TEXT PRIMARY KEY CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  what       TEXT NOT NULL CONSTRAINT "what must be area, obstacle, place, bridge or door"
             CHECK (what IN ('area', 'obstacle', 'place', 'bridge', 'door')),
  kind       TEXT CONSTRAINT "only an area or a door has a kind" CHECK (kind IS NULL OR what IN ('area', 'door')),
  outline    TEXT NOT NULL CONSTRAINT "outline must be a JSON list of corners" CHECK (json_valid(outline)),
  properties TEXT NOT NULL DEFAULT '{}'
             CONSTRAINT "properties must be a JSON object" CHECK (json_valid(properties) AND json_type(properties) = 'object'),
  until      TEXT CONSTRAINT "until must be a time in UTC, like 2026-11-21T18:00:00Z"
             CHECK (strftime('%Y-%m-%dT%H:%M:%SZ', until) IS until),
  who        TEXT NOT NULL DEFAULT '',
  why        TEXT NOT NULL DEFAULT '',
  at         TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now')),
  CONSTRAINT "a place has one corner" CHECK (what <> 'place' OR json_array_length(outline) = 1),
  CONSTRAINT "a door has two posts" CHECK (what <> 'door' OR json_array_length(outline) = 2)
) STRICT;
INSERT INTO laid SELECT * FROM laid_before;
DROP TABLE laid_before;

CREATE TRIGGER stale_laid_insert AFTER INSERT ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', NEW.name);
END;
CREATE TRIGGER stale_laid_update AFTER UPDATE ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', NEW.name);
END;
CREATE TRIGGER stale_laid_delete AFTER DELETE ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', OLD.name);
END;

-- The layer is of polygons, and neither a place nor a door is one.
CREATE TRIGGER drawn_follows_insert AFTER INSERT ON laid
WHEN NEW.what NOT IN ('place', 'door') AND NOT EXISTS (SELECT 1 FROM drawn WHERE name = NEW.name)
  AND NOT EXISTS (SELECT 1 FROM drawn AS d WHERE d.name IS NULL AND NEW.name = NEW.what || ' ' || d.fid) BEGIN
  INSERT INTO drawn (geom, name, what, kind, properties, until, why)
  SELECT geom, NEW.name, NEW.what, NEW.kind, NEW.properties, NEW.until, NEW.why FROM laid_shapes WHERE name = NEW.name;
END;
CREATE TRIGGER drawn_follows_update AFTER UPDATE ON laid
WHEN (NEW.name, NEW.what, NEW.kind, NEW.outline, NEW.properties, NEW.until, NEW.why)
  IS NOT (OLD.name, OLD.what, OLD.kind, OLD.outline, OLD.properties, OLD.until, OLD.why) BEGIN
  UPDATE drawn SET geom = (SELECT geom FROM laid_shapes WHERE name = NEW.name), name = NEW.name, what = NEW.what,
    kind = NEW.kind, properties = NEW.properties, until = NEW.until, why = NEW.why
  WHERE name IN (OLD.name, NEW.name);
END;
CREATE TRIGGER drawn_follows_delete AFTER DELETE ON laid BEGIN
  DELETE FROM drawn WHERE name = OLD.name;
END;
DROP TRIGGER drawn_is_no_place;
CREATE TRIGGER drawn_is_no_place BEFORE INSERT ON drawn
WHEN EXISTS (SELECT 1 FROM laid WHERE name = NEW.name AND what IN ('place', 'door')) BEGIN
  SELECT RAISE(ABORT, 'a place or a door of this name lies over the map already');
END;
DROP TRIGGER drawn_becomes_no_place;
CREATE TRIGGER drawn_becomes_no_place BEFORE UPDATE OF name ON drawn
WHEN EXISTS (SELECT 1 FROM laid WHERE name = NEW.name AND what IN ('place', 'door')) BEGIN
  SELECT RAISE(ABORT, 'a place or a door of this name lies over the map already');
END;
