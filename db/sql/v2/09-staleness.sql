-- Routes are stale by an edit that no build has followed up, and by the clock: what was derived holds from the site's
-- value `valid_from` up to `valid_until`, the next moment at which a fact ends or opening hours begin or end.
CREATE VIEW staleness AS
SELECT EXISTS (SELECT 1 FROM stale_marks)
    OR EXISTS (SELECT 1 FROM site WHERE key = 'valid_until' AND value <= strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
    OR EXISTS (SELECT 1 FROM site WHERE key = 'valid_from' AND value > strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
  AS stale;
