-- Where in its frame a view was cut: the box and the frame's size, in pixels of the depth image. Null: the view was
-- stored by an older version. The mask, brought to the box's size, lies at (box_x, box_y).
ALTER TABLE views ADD COLUMN box_x INTEGER;
ALTER TABLE views ADD COLUMN box_y INTEGER;
ALTER TABLE views ADD COLUMN box_width INTEGER;
ALTER TABLE views ADD COLUMN box_height INTEGER;
ALTER TABLE views ADD COLUMN frame_width INTEGER;
ALTER TABLE views ADD COLUMN frame_height INTEGER;
