-- Spaces and doorways follow from the map, from rules and from what is told. Whoever writes them by hand is told so, since
-- nothing would come of it.
CREATE TRIGGER spaces_follow_insert BEFORE INSERT ON spaces WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'spaces follow from the map, rules and what is told: nothing comes of a row of your own; close one by adit close, or by a row of told');
END;
CREATE TRIGGER spaces_follow_update BEFORE UPDATE ON spaces WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'spaces follow from the map, rules and what is told: nothing comes of what is set here; close one by adit close, or by a row of told');
END;
CREATE TRIGGER spaces_follow_delete BEFORE DELETE ON spaces WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'spaces follow from the map, rules and what is told: none is taken away here');
END;
CREATE TRIGGER doorways_follow_insert BEFORE INSERT ON doorways WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'doorways follow from the map, rules and what is told: nothing comes of a row of your own; declare one by adit open, or by a row of told');
END;
CREATE TRIGGER doorways_follow_update BEFORE UPDATE ON doorways WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'doorways follow from the map, rules and what is told: nothing comes of what is set here; close one by adit close, or by a row of told');
END;
CREATE TRIGGER doorways_follow_delete BEFORE DELETE ON doorways WHEN (SELECT NOT quiet FROM writer) BEGIN
    SELECT RAISE(ABORT, 'doorways follow from the map, rules and what is told: none is taken away here; close one by adit close, or by a row of told');
END;
