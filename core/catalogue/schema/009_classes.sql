-- Classes of objects. `id` is the category id of exported data sets: it never changes, and no other class gets it. A class
-- is never deleted: a hidden one is unused (merged_into is null) or merged into another. `color` is "#rrggbb";
-- `attributes` is a JSON list of {"name", "kind": "text", "choice" or "yes_no", "choices"}.
CREATE TABLE classes (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  color TEXT NOT NULL,
  supercategory TEXT NOT NULL DEFAULT '',
  attributes TEXT NOT NULL DEFAULT '[]',
  hidden INTEGER NOT NULL DEFAULT 0,
  merged_into INTEGER REFERENCES classes (id),
  created TEXT NOT NULL
);
CREATE UNIQUE INDEX classes_visible_name ON classes (name) WHERE hidden = 0;

-- The class of an object, perhaps merged into another one by now. Null: not classified. `attributes` is a JSON object of
-- answers by the name of the attribute; null: none.
ALTER TABLE objects ADD COLUMN class INTEGER REFERENCES classes (id);
ALTER TABLE objects ADD COLUMN attributes TEXT;
CREATE INDEX objects_class ON objects (class) WHERE class IS NOT NULL;
