-- Whether a room is entered. Where no rule speaks of it, it is.
ALTER TABLE rooms ADD COLUMN passable INTEGER CONSTRAINT "passable must be 0 or 1" CHECK (passable IN (0, 1));
ALTER TABLE rooms ADD COLUMN passable_rule INTEGER;
ALTER TABLE rooms ADD COLUMN passable_witness INTEGER;
