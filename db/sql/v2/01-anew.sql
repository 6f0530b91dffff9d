-- What is derived is derived anew by the next build; what people told, tuned and wrote stays.
DELETE FROM site WHERE key <> 'generation';
INSERT OR IGNORE INTO stale_marks SELECT 'site', 'schema' WHERE EXISTS (SELECT 1 FROM rooms);
