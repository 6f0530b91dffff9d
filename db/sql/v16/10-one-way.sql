-- The space from which nobody passes a doorway, by the name that people have for it; NULL: it is as `closed` says, from either side.
ALTER TABLE doorways ADD COLUMN closed_from TEXT;

-- The direction in which one goes through an area, degrees counterclockwise from x; NULL: in any.
ALTER TABLE area_outlines ADD COLUMN heading REAL;

DROP VIEW map_doorways;
CREATE VIEW map_doorways AS
SELECT d.doorway AS fid, coalesce(d.name, 'doorway ' || d.doorway) AS name, d.space1, d.space2, d.width, d.height, d.closed, d.closed_from,
  CAST(x'47500001FFFFFFFF0102000000'
      || x'02000000'
      || (
      SELECT group_concat(o.data, '')
      FROM (SELECT coalesce(
          ((v.atom < 0) << 63)
          | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
          | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
              * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
            FROM json_tree(printf('[%!.17g,%!.17g,%!.17g,%!.17g]', d.x0, d.y0, d.x1, d.y1)) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
      CROSS JOIN octets AS i
      CROSS JOIN octets AS o
      WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255) AS BLOB) AS geom
FROM doorways AS d;

-- What planners gave before lacks the property.
DELETE FROM site WHERE key = 'basis' OR key LIKE 'planner.%';
