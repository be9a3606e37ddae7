-- The depth camera of a frame, in pixels, for images of width x height. NULL: that of the whole scan (facts, camera).
ALTER TABLE frames ADD COLUMN fx REAL;
ALTER TABLE frames ADD COLUMN fy REAL;
ALTER TABLE frames ADD COLUMN cx REAL;
ALTER TABLE frames ADD COLUMN cy REAL;
ALTER TABLE frames ADD COLUMN width INTEGER;
ALTER TABLE frames ADD COLUMN height INTEGER;
