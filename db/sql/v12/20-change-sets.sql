-- change_set: the first entry of those that were made together, and are taken back together.
ALTER TABLE history ADD COLUMN change_set INTEGER REFERENCES history (id);
UPDATE history SET change_set = id;
CREATE INDEX history_open ON history (id) WHERE change_set IS NULL;
CREATE INDEX history_by_change_set ON history (change_set);
