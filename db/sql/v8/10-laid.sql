-- Areas and obstacles that people lay over the map while the site is in use, by name. Metres.
--
-- outline: a JSON list of corners [[x,y],…]. properties: a JSON object of what else is said of an area. `until` is in UTC;
-- what is over lies there no more.
CREATE TABLE laid (
  name       TEXT PRIMARY KEY CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  what       TEXT NOT NULL CONSTRAINT "what must be area or obstacle" CHECK (what IN ('area', 'obstacle')),
  kind       TEXT CONSTRAINT "only an area has a kind" CHECK (kind IS NULL OR what = 'area'),
  outline    TEXT NOT NULL CONSTRAINT "outline must be a JSON list of corners" CHECK (json_valid(outline)),
  properties TEXT NOT NULL DEFAULT '{}'
             CONSTRAINT "properties must be a JSON object" CHECK (json_valid(properties) AND json_type(properties) = 'object'),
  until      TEXT CONSTRAINT "until must be a time in UTC, like 2026-11-21T18:00:00Z"
             CHECK (strftime('%Y-%m-%dT%H:%M:%SZ', until) IS until),
  who        TEXT NOT NULL DEFAULT '',
  why        TEXT NOT NULL DEFAULT '',
  at         TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;

CREATE TRIGGER stale_laid_insert AFTER INSERT ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', NEW.name);
END;
CREATE TRIGGER stale_laid_update AFTER UPDATE ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', NEW.name);
END;
CREATE TRIGGER stale_laid_delete AFTER DELETE ON laid WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('laid', OLD.name);
END;
