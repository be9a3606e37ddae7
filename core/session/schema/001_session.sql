-- A scan as it goes on disk. Times are ISO 8601, UTC. Application id 1399018341 = "ScSe" marks the file.
PRAGMA application_id = 1399018341;

CREATE TABLE schema_migrations (
  version INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  applied TEXT NOT NULL
);

-- What holds for the whole scan: source, params (TOML), camera (JSON), database, started, ended (missing: it broke off).
CREATE TABLE facts (
  name TEXT PRIMARY KEY,
  value TEXT NOT NULL
) WITHOUT ROWID;

-- Frames that the scan has seen. `state` is a word of TrackingState; T_world_camera as in the trajectory.
CREATE TABLE frames (
  number INTEGER PRIMARY KEY,
  source_index INTEGER NOT NULL,
  time_s REAL NOT NULL,
  state TEXT NOT NULL,
  tx REAL, ty REAL, tz REAL, qx REAL, qy REAL, qz REAL, qw REAL
);

CREATE TABLE key_frames (
  number INTEGER PRIMARY KEY REFERENCES frames (number),
  color_file TEXT NOT NULL,
  depth_file TEXT NOT NULL,
  metres_per_unit REAL NOT NULL,
  color TEXT NOT NULL
);

CREATE TABLE fragments (
  fragment INTEGER PRIMARY KEY,
  region INTEGER NOT NULL,
  voxels INTEGER NOT NULL
);

CREATE TABLE regions (
  region INTEGER PRIMARY KEY,
  object INTEGER NOT NULL,
  name TEXT NOT NULL,
  category TEXT NOT NULL,
  background INTEGER NOT NULL,
  is_object INTEGER NOT NULL,
  rejected INTEGER NOT NULL
);

-- What is known of the border between two fragments, a < b: ten 32-bit floats.
CREATE TABLE borders (
  a INTEGER NOT NULL,
  b INTEGER NOT NULL,
  evidence BLOB NOT NULL,
  said INTEGER NOT NULL,
  by_person INTEGER NOT NULL,
  said_order INTEGER NOT NULL,
  PRIMARY KEY (a, b)
) WITHOUT ROWID;

-- `operation` and `effect` are JSON; `state` is a word of OperationLog::State.
CREATE TABLE operations (
  number INTEGER PRIMARY KEY,
  state TEXT NOT NULL,
  operation TEXT NOT NULL,
  effect TEXT NOT NULL,
  done TEXT NOT NULL
);

-- Where the newest record of each page of bricks lies.
CREATE TABLE pages (
  x INTEGER NOT NULL,
  y INTEGER NOT NULL,
  z INTEGER NOT NULL,
  file INTEGER NOT NULL,
  offset INTEGER NOT NULL,
  bytes INTEGER NOT NULL,
  unpacked_bytes INTEGER NOT NULL,
  checksum INTEGER NOT NULL,
  PRIMARY KEY (x, y, z)
) WITHOUT ROWID;
