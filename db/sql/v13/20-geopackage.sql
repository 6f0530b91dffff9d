-- The database as a GeoPackage, whose layers GDAL, QGIS and others show: rooms, spaces, doorways, areas and routes are views,
-- `drawn` is a table into which they write. The application id stays ours, about which GDAL warns.
--
-- A geometry is eight bytes of a head, and then the shape in well-known binary, its numbers as the machine keeps them. Since
-- no function of SQLite before 3.41 makes bytes of numbers, bytes are found in a table. What is nearer to 0 than 1e-38 is 0.

-- data: the octet as a blob. power: 2^(octet - 128).
CREATE TABLE octets (
  octet INTEGER PRIMARY KEY,
  data  BLOB NOT NULL UNIQUE,
  power REAL NOT NULL UNIQUE
) STRICT;
INSERT INTO octets
WITH RECURSIVE n (octet, power) AS (
  SELECT 0, 1.0 / (1 << 62) / (1 << 62) / 16
  UNION ALL SELECT octet + 1, power * 2.0 FROM n WHERE octet < 255)
SELECT octet, substr(CAST(
  x'000102030405060708090A0B0C0D0E0F101112131415161718191A1B1C1D1E1F202122232425262728292A2B2C2D2E2F303132333435363738393A3B3C3D3E3F'
  || x'404142434445464748494A4B4C4D4E4F505152535455565758595A5B5C5D5E5F606162636465666768696A6B6C6D6E6F707172737475767778797A7B7C7D7E7F'
  || x'808182838485868788898A8B8C8D8E8F909192939495969798999A9B9C9D9E9FA0A1A2A3A4A5A6A7A8A9AAABACADAEAFB0B1B2B3B4B5B6B7B8B9BABBBCBDBEBF'
  || x'C0C1C2C3C4C5C6C7C8C9CACBCCCDCECFD0D1D2D3D4D5D6D7D8D9DADBDCDDDEDFE0E1E2E3E4E5E6E7E8E9EAEBECEDEEEFF0F1F2F3F4F5F6F7F8F9FAFBFCFDFEFF' AS BLOB), octet + 1, 1), power FROM n;

-- The areas of the map and those that are laid over it. outline: a JSON list of corners [[x,y],…], metres.
CREATE TABLE area_outlines (
  area    TEXT PRIMARY KEY,
  kind    TEXT,
  outline TEXT NOT NULL CHECK (json_valid(outline))
) STRICT, WITHOUT ROWID;


CREATE VIEW map_rooms AS
SELECT r.room AS fid, r.name, r.robot, r.state, r.facing, r.height, r.width, r.space, r.hardness, r.action, r.passable,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(r.rings) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(r.rings) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(r.rings) AS ring) AS BLOB) AS geom
FROM (SELECT *, coalesce('[' || outline || ']', printf('[[[%!.17g,%!.17g],[%!.17g,%!.17g],[%!.17g,%!.17g],[%!.17g,%!.17g]]]',
    x0, y0, x1, y0, x1, y1, x0, y1)) AS rings FROM rooms) AS r;

CREATE VIEW map_spaces AS
SELECT s.space AS fid, coalesce(s.name, 'space ' || s.space) AS name, s.kind, s.area, s.breadth, s.closed,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(s.outline) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(s.outline) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(s.outline) AS ring) AS BLOB) AS geom
FROM spaces AS s;

CREATE VIEW map_doorways AS
SELECT d.doorway AS fid, coalesce(d.name, 'doorway ' || d.doorway) AS name, d.space1, d.space2, d.width, d.height, d.closed,
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

CREATE VIEW map_areas AS
SELECT a.area AS name, a.kind,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(a.rings) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(a.rings) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(a.rings) AS ring) AS BLOB) AS geom
FROM (SELECT area, kind, '[' || outline || ']' AS rings FROM area_outlines) AS a;

CREATE VIEW map_routes AS
SELECT r.robot, r.start, r.goal, r.status, r.cost, r.distance,
  CAST(x'47500001FFFFFFFF0102000000'
      || (SELECT data FROM octets WHERE octet = (json_array_length(r.points) / 2) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(r.points) / 2) >> 8 & 255) || x'0000'
      || (
      SELECT group_concat(o.data, '')
      FROM (SELECT coalesce(
          ((v.atom < 0) << 63)
          | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
          | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
              * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
            FROM json_tree(r.points) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
      CROSS JOIN octets AS i
      CROSS JOIN octets AS o
      WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255) AS BLOB) AS geom
FROM (SELECT robot, start, goal, status, cost, distance, '[' || (
    SELECT group_concat(printf('%!.17g,%!.17g', x, y))
    FROM (SELECT w.x AS x, w.y AS y FROM waypoints AS w
          WHERE w.robot = route.robot AND w.start = route.start AND w.goal = route.goal ORDER BY w.waypoint)) || ']' AS points
  FROM route WHERE status IN ('ok', 'same_room', 'stale') LIMIT -1) AS r
WHERE json_array_length(r.points) > 2;

-- What people laid over the map as a layer that GDAL writes to: what is drawn, changed or deleted there is laid, laid otherwise or
-- lifted, and the other way round. A shape without a name is named by its number.
CREATE TABLE drawn (
  fid        INTEGER PRIMARY KEY,
  geom       BLOB NOT NULL,
  name       TEXT UNIQUE,
  what       TEXT DEFAULT 'area',
  kind       TEXT,
  properties TEXT DEFAULT '{}',
  until      TEXT,
  why        TEXT DEFAULT ''
) STRICT;

CREATE VIEW laid_shapes AS
SELECT l.name,
  CAST(x'47500001FFFFFFFF0103000000' || (SELECT data FROM octets WHERE octet = json_array_length(l.rings) & 255)
      || (SELECT data FROM octets WHERE octet = json_array_length(l.rings) >> 8 & 255) || x'0000' || (
    SELECT group_concat(
      (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) & 255)
      || (SELECT data FROM octets WHERE octet = (json_array_length(ring.value) + 1) >> 8 & 255) || x'0000'
      || (
        SELECT group_concat(o.data, '')
        FROM (SELECT coalesce(
            ((v.atom < 0) << 63)
            | (((SELECT octet FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1) + 895) << 52)
            | CAST(abs(v.atom) / (SELECT power FROM octets WHERE power <= abs(v.atom) ORDER BY power DESC LIMIT 1)
                * 4503599627370496.0 AS INTEGER) - 4503599627370496, 0) AS bits
              FROM json_tree(json_insert(ring.value, '$[#]', json_extract(ring.value, '$[0]'))) AS v WHERE v.atom IS NOT NULL LIMIT -1) AS n
        CROSS JOIN octets AS i
        CROSS JOIN octets AS o
        WHERE i.octet < 8 AND o.octet = n.bits >> 8 * i.octet & 255), '')
    FROM json_each(l.rings) AS ring) AS BLOB) AS geom
FROM (SELECT name, '[' || outline || ']' AS rings FROM laid) AS l;

-- outline: the corners of the shape, of which the last is the first again; NULL where it is not one ring of finite numbers.
CREATE VIEW drawn_outlines AS
SELECT w.fid, CASE WHEN substr(w.geom, 1, 2) = x'4750' AND substr(w.geom, w.at, 9) = x'010300000001000000'
    AND w.corners > 3 AND length(w.geom) = w.at + 12 + 16 * w.corners THEN (
  SELECT CASE WHEN count(c.number) = 2 * w.corners - 2 THEN '[' || group_concat(
    CASE WHEN c.place % 2 = 0 THEN '[' ELSE '' END || c.number || CASE WHEN c.place % 2 = 0 THEN '' ELSE ']' END) || ']' END
  FROM (
    SELECT b.place, CASE WHEN CAST(printf('%!.15g', b.value) AS REAL) = b.value
      THEN printf('%!.15g', b.value) ELSE printf('%!.17g', b.value) END AS number
    FROM (
      SELECT n.place, CASE WHEN n.bits & 9223372036854775807 = 0 THEN 0.0 ELSE
        CASE WHEN n.bits < 0 THEN -1.0 ELSE 1.0 END * (1.0 + (n.bits & 4503599627370495) / 4503599627370496.0)
        * (SELECT power FROM octets WHERE octet = (n.bits >> 52 & 2047) - 895) END AS value
      FROM (
        SELECT 256 * p.octet + q.octet AS place, (
          SELECT sum(o.octet << 8 * i.octet) FROM octets AS i CROSS JOIN octets AS o
          WHERE i.octet < 8 AND o.data = substr(w.geom, w.at + 13 + 8 * (256 * p.octet + q.octet) + i.octet, 1)) AS bits
        FROM octets AS p CROSS JOIN octets AS q
        WHERE p.octet <= (2 * w.corners - 3) / 256 AND 256 * p.octet + q.octet < 2 * w.corners - 2 LIMIT -1) AS n
      LIMIT -1) AS b
    LIMIT -1) AS c) END AS outline
FROM (
  SELECT g.fid, g.geom, g.at, (
    SELECT sum(o.octet << 8 * i.octet) FROM octets AS i CROSS JOIN octets AS o
    WHERE i.octet < 4 AND o.data = substr(g.geom, g.at + 9 + i.octet, 1)) AS corners
  FROM (
    SELECT fid, geom, 9 + CASE (SELECT octet FROM octets WHERE data = substr(geom, 4, 1)) >> 1 & 7
      WHEN 0 THEN 0 WHEN 1 THEN 32 WHEN 2 THEN 48 WHEN 3 THEN 48 WHEN 4 THEN 64 END AS at
    FROM drawn) AS g) AS w;

CREATE TRIGGER drawn_insert AFTER INSERT ON drawn
WHEN NEW.name IS NULL OR NOT EXISTS (SELECT 1 FROM laid WHERE name = NEW.name) BEGIN
  SELECT RAISE(ABORT, 'an area is one polygon without holes, of three corners or more, each two finite numbers')
  WHERE (SELECT outline FROM drawn_outlines WHERE fid = NEW.fid) IS NULL;
  INSERT INTO laid (name, what, kind, outline, properties, until, why)
  SELECT coalesce(NEW.name, coalesce(NEW.what, 'area') || ' ' || NEW.fid), coalesce(NEW.what, 'area'), NEW.kind, outline,
    coalesce(NEW.properties, '{}'), NEW.until, coalesce(NEW.why, '')
  FROM drawn_outlines WHERE fid = NEW.fid;
  UPDATE drawn SET name = coalesce(NEW.name, coalesce(NEW.what, 'area') || ' ' || NEW.fid),
    what = coalesce(NEW.what, 'area'), properties = coalesce(NEW.properties, '{}'), why = coalesce(NEW.why, '')
  WHERE fid = NEW.fid;
END;

-- What follows the table `laid` says nothing new of it.
CREATE TRIGGER drawn_update AFTER UPDATE ON drawn
WHEN OLD.name IS NOT NULL AND NOT EXISTS (
  SELECT 1 FROM laid AS l JOIN laid_shapes AS s ON s.name = l.name
  WHERE l.name = NEW.name AND l.what = NEW.what AND l.kind IS NEW.kind AND l.properties = NEW.properties
    AND l.until IS NEW.until AND l.why = NEW.why AND s.geom = NEW.geom) BEGIN
  SELECT RAISE(ABORT, 'what lies over the map needs a name') WHERE NEW.name IS NULL;
  SELECT RAISE(ABORT, 'an area is one polygon without holes, of three corners or more, each two finite numbers')
  WHERE (SELECT outline FROM drawn_outlines WHERE fid = NEW.fid) IS NULL;
  UPDATE laid SET name = NEW.name, what = coalesce(NEW.what, 'area'), kind = NEW.kind,
    outline = (SELECT outline FROM drawn_outlines WHERE fid = NEW.fid), properties = coalesce(NEW.properties, '{}'),
    until = NEW.until, why = coalesce(NEW.why, '')
  WHERE name = OLD.name;
END;
CREATE TRIGGER drawn_delete AFTER DELETE ON drawn BEGIN
  DELETE FROM laid WHERE name = OLD.name;
END;

CREATE TRIGGER drawn_follows_insert AFTER INSERT ON laid
WHEN NOT EXISTS (SELECT 1 FROM drawn WHERE name = NEW.name)
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

INSERT INTO drawn (geom, name, what, kind, properties, until, why)
SELECT s.geom, l.name, l.what, l.kind, l.properties, l.until, l.why FROM laid AS l JOIN laid_shapes AS s ON s.name = l.name
ORDER BY l.name;

-- The tables by which a GeoPackage says what is in it. Somebody may have put layers of their own there before.
CREATE TABLE IF NOT EXISTS gpkg_spatial_ref_sys (
  srs_name                 TEXT NOT NULL,
  srs_id                   INTEGER NOT NULL PRIMARY KEY,
  organization             TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL,
  definition               TEXT NOT NULL,
  description              TEXT
);
INSERT OR IGNORE INTO gpkg_spatial_ref_sys VALUES
  ('Undefined Cartesian SRS', -1, 'NONE', -1, 'undefined', 'metres of the map'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'),
  ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]]', 'longitude and latitude');

CREATE TABLE IF NOT EXISTS gpkg_contents (
  table_name  TEXT NOT NULL PRIMARY KEY,
  data_type   TEXT NOT NULL,
  identifier  TEXT UNIQUE,
  description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  min_x       DOUBLE,
  min_y       DOUBLE,
  max_x       DOUBLE,
  max_y       DOUBLE,
  srs_id      INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id)
);
CREATE TABLE IF NOT EXISTS gpkg_geometry_columns (
  table_name         TEXT NOT NULL,
  column_name        TEXT NOT NULL,
  geometry_type_name TEXT NOT NULL,
  srs_id             INTEGER NOT NULL,
  z                  TINYINT NOT NULL,
  m                  TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name),
  CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents (table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id)
);
INSERT INTO gpkg_contents (table_name, data_type, identifier, description, last_change, srs_id) VALUES
  ('map_rooms', 'features', 'rooms', 'rooms of all layers, with what rules say', '2026-11-24T00:00:00.000Z', -1),
  ('map_spaces', 'features', 'spaces', 'spaces as people see them', '2026-11-24T00:00:00.000Z', -1),
  ('map_doorways', 'features', 'doorways', 'openings between spaces', '2026-11-24T00:00:00.000Z', -1),
  ('map_areas', 'features', 'areas', 'areas of the map, and those laid over it', '2026-11-24T00:00:00.000Z', -1),
  ('map_routes', 'features', 'routes', 'the routes that are kept', '2026-11-24T00:00:00.000Z', -1),
  ('drawn', 'features', 'drawn', 'areas and obstacles laid over the map: draw here', '2026-11-24T00:00:00.000Z', -1);
INSERT INTO gpkg_geometry_columns
SELECT table_name, 'geom', CASE WHEN table_name IN ('map_doorways', 'map_routes') THEN 'LINESTRING' ELSE 'POLYGON' END, -1, 0, 0
FROM gpkg_contents WHERE table_name IN ('map_rooms', 'map_spaces', 'map_doorways', 'map_areas', 'map_routes', 'drawn');

-- The outlines of areas are written by the next build.
DELETE FROM site WHERE key = 'basis';
