-- Rooms are convex polygons: x0, y0, x1, y1 is the least rectangle about one, and outline its corners as JSON, [[x,y],…],
-- counterclockwise, metres. NULL where the room is that rectangle.
ALTER TABLE rooms ADD COLUMN outline TEXT CONSTRAINT "outline must be a JSON list of at least three corners [x,y]"
  CHECK (json_valid(outline) AND json_array_length(outline) >= 3);

-- Of the disc whose middle may be anywhere in the room, metres: about corners of walls it may come nearer than to the outline.
ALTER TABLE rooms ADD COLUMN radius REAL;

-- What was cut before is cut anew, and its blocks, which know no outlines, are written anew.
DELETE FROM site WHERE key = 'basis' OR key LIKE 'planner.%';
DELETE FROM blocks WHERE class = 'rooms';
