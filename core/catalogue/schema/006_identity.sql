-- Which catalogue this is: a random UUID (version 4). Whoever keeps numbers of objects keeps it with them; a copy of the
-- file has the same one. One row.
CREATE TABLE identity (
  one INTEGER PRIMARY KEY CHECK (one = 1),
  uuid TEXT NOT NULL
);
INSERT INTO identity (one, uuid)
  SELECT 1, lower(hex(randomblob(4)) || '-' || hex(randomblob(2)) || '-4' || substr(hex(randomblob(2)), 2) || '-' ||
                  substr('89AB', 1 + abs(random() % 4), 1) || substr(hex(randomblob(2)), 2) || '-' ||
                  hex(randomblob(6)));
