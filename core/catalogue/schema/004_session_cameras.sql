-- The depth camera of a session, as its images have it: pixels. Null: the session was stored by an older version, or the
-- camera is not known.
ALTER TABLE sessions ADD COLUMN fx REAL;
ALTER TABLE sessions ADD COLUMN fy REAL;
ALTER TABLE sessions ADD COLUMN cx REAL;
ALTER TABLE sessions ADD COLUMN cy REAL;
ALTER TABLE sessions ADD COLUMN image_width INTEGER;
ALTER TABLE sessions ADD COLUMN image_height INTEGER;
