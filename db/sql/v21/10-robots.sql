-- Which robot it was, where several drive at once; NULL of missions that were kept before.
ALTER TABLE missions ADD COLUMN robot TEXT;
