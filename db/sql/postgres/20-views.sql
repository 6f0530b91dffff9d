-- The views that people ask, by the names that they have in SQLite, each with `site` before its columns. Ask with the site and
-- the key: `WHERE site = … AND robot = … AND start = … AND goal = …`.

CREATE VIEW adit.staleness AS
SELECT s.site,
  EXISTS (SELECT 1 FROM adit.stale_marks m WHERE m.site = s.site)
  OR EXISTS (SELECT 1 FROM adit.site v WHERE v.site = s.site AND v.key = 'valid_until'
             AND v.value <= to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"'))
  OR EXISTS (SELECT 1 FROM adit.site v WHERE v.site = s.site AND v.key = 'valid_from'
             AND v.value > to_char(now() AT TIME ZONE 'UTC', 'YYYY-MM-DD"T"HH24:MI:SS"Z"')) AS stale
FROM adit.sites s;
