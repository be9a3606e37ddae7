-- The fact `catalogue` is the identity of the catalogue that all numbers of objects are of. A session of an older version
-- has none; the fact `begun`, when it was created, tells its catalogue.
INSERT OR IGNORE INTO facts (name, value)
  SELECT 'begun', applied FROM schema_migrations WHERE version = 1 AND EXISTS (SELECT 1 FROM facts);
