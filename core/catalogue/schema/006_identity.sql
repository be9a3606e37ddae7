-- Which catalogue this is: a random UUID (version 4). Whoever keeps numbers of objects keeps it with them; a copy of the
-- file has the same one. One row. core/database/sql_dialect.cpp says what random_uuid() is.
CREATE TABLE identity (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  uuid TEXT NOT NULL
);
INSERT INTO identity (one, uuid)
  SELECT 1, random_uuid();
