-- The catalogue. Plain SQL for SQLite and PostgreSQL: core/database/sql_dialect.h replaces the column types that differ.
-- Times are ISO 8601, UTC.
-- Application id 1399025268 = "Scnt" marks the file as a Scantrove catalogue.
PRAGMA application_id = 1399025268;

CREATE TABLE schema_migrations (
  version INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  applied TEXT NOT NULL
);

-- One scan of one source.
CREATE TABLE sessions (
  id INTEGER PRIMARY KEY,
  source TEXT NOT NULL,
  started TEXT NOT NULL,
  ended TEXT
);

-- `number` is the N of the generated name Obj_N; it is given once and never again, whatever the object is called now.
-- Hidden objects of discarded views have numbers below 0.
-- A hidden object was removed (merged_into is null) or merged into another.
CREATE TABLE objects (
  id INTEGER PRIMARY KEY,
  number INTEGER NOT NULL UNIQUE,
  name TEXT NOT NULL,
  confirmed INTEGER NOT NULL DEFAULT 0,
  hidden INTEGER NOT NULL DEFAULT 0,
  merged_into INTEGER REFERENCES objects (id),
  size_x_m REAL NOT NULL,
  size_y_m REAL NOT NULL,
  size_z_m REAL NOT NULL,
  first_session INTEGER REFERENCES sessions (id),
  created TEXT NOT NULL
);
CREATE UNIQUE INDEX objects_visible_name ON objects (name) WHERE hidden = 0;
CREATE INDEX objects_merged_into ON objects (merged_into);

-- One look at an object. `object` is who owns it now, `first_object` who owned it before any merge.
-- Images are PNG files; pose is the twelve numbers of T_world_camera's upper rows, row by row.
CREATE TABLE views (
  id INTEGER PRIMARY KEY,
  object INTEGER NOT NULL REFERENCES objects (id),
  first_object INTEGER NOT NULL REFERENCES objects (id),
  session INTEGER REFERENCES sessions (id),
  frame_index INTEGER NOT NULL,
  pose TEXT NOT NULL,
  direction_x REAL NOT NULL,
  direction_y REAL NOT NULL,
  direction_z REAL NOT NULL,
  created TEXT NOT NULL,
  color BLOB NOT NULL,
  mask BLOB NOT NULL,
  depth_mm BLOB NOT NULL
);
CREATE INDEX views_object ON views (object);
CREATE INDEX views_first_object ON views (first_object);

-- Everything that changed the catalogue: before and after are JSON texts, null where there is nothing to say.
CREATE TABLE events (
  id INTEGER PRIMARY KEY,
  created TEXT NOT NULL,
  action TEXT NOT NULL,
  object INTEGER REFERENCES objects (id),
  session INTEGER REFERENCES sessions (id),
  before_json TEXT,
  after_json TEXT
);
CREATE INDEX events_object ON events (object);
