-- The name `areas` is that of the areas that people name; prime areas are kept as `prime_area_strips` behind their view.
DROP VIEW conclusions;
DROP VIEW prime_areas;
DROP TABLE areas;

CREATE TABLE prime_area_strips (
  area    INTEGER PRIMARY KEY CHECK (area > 0),
  x_first INTEGER NOT NULL CHECK (x_first >= 0),
  x_last  INTEGER NOT NULL CHECK (x_last >= x_first),
  y_first INTEGER NOT NULL CHECK (y_first >= 0),
  y_last  INTEGER NOT NULL CHECK (y_last >= y_first),
  open    INTEGER CHECK (open IN (0, 1)),
  open_rule    INTEGER,
  open_witness INTEGER
) STRICT;

CREATE VIEW prime_areas AS
SELECT a.area AS area,
  substr(hex(zeroblob(a.x_first)), 1, a.x_first)
    || substr(replace(hex(zeroblob(a.x_last - a.x_first + 1)), '0', '1'), 1, a.x_last - a.x_first + 1)
    || substr(hex(zeroblob(x.strips)), 1, x.strips - a.x_last - 1) AS left_string,
  substr(hex(zeroblob(a.y_first)), 1, a.y_first)
    || substr(replace(hex(zeroblob(a.y_last - a.y_first + 1)), '0', '1'), 1, a.y_last - a.y_first + 1)
    || substr(hex(zeroblob(y.strips)), 1, y.strips - a.y_last - 1) AS right_string,
  x0.low AS x0, y0.low AS y0, x1.high AS x1, y1.high AS y1,
  a.open AS open
FROM (SELECT count(*) AS strips FROM strips WHERE axis = 'x') AS x
CROSS JOIN (SELECT count(*) AS strips FROM strips WHERE axis = 'y') AS y
CROSS JOIN prime_area_strips AS a
LEFT JOIN strips AS x0 ON x0.axis = 'x' AND x0.strip = a.x_first
LEFT JOIN strips AS y0 ON y0.axis = 'y' AND y0.strip = a.y_first
LEFT JOIN strips AS x1 ON x1.axis = 'x' AND x1.strip = a.x_last
LEFT JOIN strips AS y1 ON y1.axis = 'y' AND y1.strip = a.y_last;
