-- How much farther off walls than the room's outline ways keep, metres, as long as that costs no more than a share of what the
-- best way costs. NULL: they keep no farther.
ALTER TABLE rooms ADD COLUMN berth REAL;
ALTER TABLE rooms ADD COLUMN berth_cost REAL;

-- What was cut before is cut anew, and its blocks, which know no berths, are written anew.
DELETE FROM site WHERE key = 'basis' OR key LIKE 'planner.%';
DELETE FROM blocks WHERE class = 'rooms';
