-- What the whole site has: its settings, the robots' states, named points and frames.
-- A constraint's name is the sentence that its user reads when it refuses a value.

CREATE TABLE site (
  key   TEXT PRIMARY KEY CONSTRAINT "key must not be empty" CHECK (length(key) > 0),
  value TEXT NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE robots (
  robot    TEXT NOT NULL CONSTRAINT "robot must not be empty" CHECK (length(robot) > 0),
  state    TEXT NOT NULL CONSTRAINT "state must not be empty" CHECK (length(state) > 0),
  action   TEXT NOT NULL CONSTRAINT "action must not be empty" CHECK (length(action) > 0),
  height   REAL NOT NULL CONSTRAINT "height must be finite and not negative" CHECK (height BETWEEN 0 AND 1e300),
  width    REAL NOT NULL CONSTRAINT "width must be finite and not negative" CHECK (width BETWEEN 0 AND 1e300),
  hardness REAL NOT NULL CONSTRAINT "hardness must be finite and not negative" CHECK (hardness BETWEEN 0 AND 1e300),
  position INTEGER NOT NULL DEFAULT 0 CONSTRAINT "position must not be negative" CHECK (position >= 0),
  PRIMARY KEY (robot, state)
) STRICT, WITHOUT ROWID;

CREATE TABLE changes (
  robot      TEXT NOT NULL,
  from_state TEXT NOT NULL,
  to_state   TEXT NOT NULL,
  hardness   REAL NOT NULL CONSTRAINT "hardness must be finite and not negative" CHECK (hardness BETWEEN 0 AND 1e300),
  PRIMARY KEY (robot, from_state, to_state),
  FOREIGN KEY (robot, from_state) REFERENCES robots (robot, state) ON UPDATE CASCADE ON DELETE CASCADE,
  FOREIGN KEY (robot, to_state) REFERENCES robots (robot, state) ON UPDATE CASCADE ON DELETE CASCADE
) STRICT, WITHOUT ROWID;

CREATE TABLE places (
  place TEXT PRIMARY KEY CONSTRAINT "place must not be empty" CHECK (length(place) > 0),
  x REAL NOT NULL CONSTRAINT "x must be finite" CHECK (x BETWEEN -1e300 AND 1e300),
  y REAL NOT NULL CONSTRAINT "y must be finite" CHECK (y BETWEEN -1e300 AND 1e300)
) STRICT, WITHOUT ROWID;

-- The pose of a frame's origin in the world: metres, and radians counterclockwise as in ROS map files.
CREATE TABLE frames (
  frame TEXT PRIMARY KEY CONSTRAINT "frame must not be empty" CHECK (length(frame) > 0),
  x   REAL NOT NULL CONSTRAINT "x must be finite" CHECK (x BETWEEN -1e300 AND 1e300),
  y   REAL NOT NULL CONSTRAINT "y must be finite" CHECK (y BETWEEN -1e300 AND 1e300),
  yaw REAL NOT NULL CONSTRAINT "yaw must be finite" CHECK (yaw BETWEEN -1e300 AND 1e300)
) STRICT, WITHOUT ROWID;
