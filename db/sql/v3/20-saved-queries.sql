-- Queries that people keep, by name.
CREATE TABLE saved_queries (
  name  TEXT PRIMARY KEY CONSTRAINT "name must not be empty" CHECK (length(trim(name)) > 0),
  query TEXT NOT NULL,
  who   TEXT NOT NULL,
  at    TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))
) STRICT;
