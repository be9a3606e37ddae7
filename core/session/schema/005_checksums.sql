-- Checksums of rows (CRC-32, core/session/checked_rows.h); NULL in rows of an earlier version.
ALTER TABLE facts ADD COLUMN row_check INTEGER;
ALTER TABLE frames ADD COLUMN row_check INTEGER;
ALTER TABLE key_frames ADD COLUMN row_check INTEGER;
ALTER TABLE fragments ADD COLUMN row_check INTEGER;
ALTER TABLE regions ADD COLUMN row_check INTEGER;
ALTER TABLE borders ADD COLUMN row_check INTEGER;
ALTER TABLE operations ADD COLUMN row_check INTEGER;
ALTER TABLE pages ADD COLUMN row_check INTEGER;
ALTER TABLE camera ADD COLUMN row_check INTEGER;

-- CRC-32 of the key frames' image files.
ALTER TABLE key_frames ADD COLUMN color_checksum INTEGER;
ALTER TABLE key_frames ADD COLUMN depth_checksum INTEGER;

-- How many rows a table has, and the sum of their checksums.
CREATE TABLE table_sums (
  name TEXT PRIMARY KEY,
  rows INTEGER NOT NULL,
  sum INTEGER NOT NULL
) WITHOUT ROWID;

-- The facts once more: without some of them no session can be opened.
CREATE TABLE fact_copies (
  name TEXT PRIMARY KEY,
  value TEXT NOT NULL,
  row_check INTEGER
) WITHOUT ROWID;

-- Every file that the scan made in the session's folder, from before it was made. `state`: new (nothing names it yet),
-- kept, old (nothing names it any more: it is removed).
CREATE TABLE files (
  name TEXT PRIMARY KEY,
  state TEXT NOT NULL,
  row_check INTEGER
) WITHOUT ROWID;

INSERT OR IGNORE INTO files (name, state) SELECT color_file, 'kept' FROM key_frames WHERE color_file <> '';
INSERT OR IGNORE INTO files (name, state) SELECT depth_file, 'kept' FROM key_frames;
INSERT OR IGNORE INTO files (name, state) SELECT DISTINCT 'map/' || printf('%06d', file) || '.bricks', 'kept' FROM pages;
INSERT INTO fact_copies (name, value) SELECT name, value FROM facts;
