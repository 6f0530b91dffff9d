-- When a named area or door is open: as people edit it, and as site.toml says. Days like `mon-fri` or `sat,sun`, times
-- of the site's time zone.
CREATE TABLE hours (
  name   TEXT NOT NULL CONSTRAINT "name must not be empty" CHECK (length(name) > 0),
  days   TEXT NOT NULL DEFAULT 'mon-sun' CONSTRAINT "days must not be empty" CHECK (length(days) > 0),
  opens  TEXT NOT NULL CONSTRAINT "opens must be a time from 00:00 to 23:59"
         CHECK (opens GLOB '[0-2][0-9]:[0-5][0-9]' AND opens < '24:00'),
  closes TEXT NOT NULL CONSTRAINT "closes must be a time up to 24:00"
         CHECK (closes GLOB '[0-2][0-9]:[0-5][0-9]' AND closes <= '24:00'),
  PRIMARY KEY (name, days, opens),
  CONSTRAINT "hours end before they begin: hours past midnight are two rows, one up to 24:00 and one from 00:00"
    CHECK (closes > opens)
) STRICT, WITHOUT ROWID;

CREATE TABLE site_hours (
  name TEXT NOT NULL, days TEXT NOT NULL, opens TEXT NOT NULL, closes TEXT NOT NULL,
  PRIMARY KEY (name, days, opens)
) STRICT, WITHOUT ROWID;

CREATE VIEW opening_hours AS
SELECT name, days, opens, closes, 'site.toml' AS source FROM site_hours
UNION ALL SELECT name, days, opens, closes, 'hours' FROM hours;

CREATE TRIGGER stale_hours_insert AFTER INSERT ON hours WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('hours', NEW.name);
END;
CREATE TRIGGER stale_hours_update AFTER UPDATE ON hours WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('hours', NEW.name);
END;
CREATE TRIGGER stale_hours_delete AFTER DELETE ON hours WHEN (SELECT NOT quiet FROM writer) BEGIN
  INSERT OR IGNORE INTO stale_marks VALUES ('hours', OLD.name);
END;
