-- What lists, recognition and the objects' sizes need of a view, computed from its images once and kept in tables of
-- their own: a scan of these reads no image pages. To compute it anew (another way of describing views), a later
-- migration empties `descriptors` and `pictures` and sets object_pixels to null.

-- object_pixels is the mask's area; null: the view was stored by an older version and is not summarised yet;
-- 0: the view has no usable images. The size is the oriented box's of this look, sides in metres, longest first;
-- zero: unknown. first_object is that of `views`; it never changes.
CREATE TABLE view_summaries (
  view INTEGER PRIMARY KEY REFERENCES views (id),
  first_object INTEGER NOT NULL REFERENCES objects (id),
  object_pixels INTEGER,
  size_x_m REAL NOT NULL,
  size_y_m REAL NOT NULL,
  size_z_m REAL NOT NULL
);
CREATE INDEX view_summaries_missing ON view_summaries (view) WHERE object_pixels IS NULL;

-- The 32 x 32 Lab thumbnail that recognition compares: `fine` is 3 planes of 1024 signed bytes.
CREATE TABLE descriptors (
  view INTEGER PRIMARY KEY REFERENCES views (id),
  mean_l REAL NOT NULL,
  mean_a REAL NOT NULL,
  mean_b REAL NOT NULL,
  fine BLOB NOT NULL
);

-- A small JPEG picture of the view for lists.
CREATE TABLE pictures (
  view INTEGER PRIMARY KEY REFERENCES views (id),
  jpeg BLOB NOT NULL
);

INSERT INTO view_summaries (view, first_object, object_pixels, size_x_m, size_y_m, size_z_m)
  SELECT v.id, v.first_object, NULL, o.size_x_m, o.size_y_m, o.size_z_m
  FROM views v JOIN objects o ON o.id = v.first_object;

-- The size in `objects` is the median of the views', best_view the one that shows most of the object.
ALTER TABLE objects ADD COLUMN best_view INTEGER REFERENCES views (id);
UPDATE objects SET best_view = (SELECT max(v.id) FROM views v WHERE v.object = objects.id);

-- 1: a person gave the name; 0: it is the generated Obj_N (or "Obj_N (2)", restored when Obj_N was taken).
ALTER TABLE objects ADD COLUMN named_by_person INTEGER NOT NULL DEFAULT 0;
UPDATE objects SET named_by_person = 1
  WHERE name <> 'Obj_' || number
    AND NOT (substr(name, 1, length('Obj_' || number || ' (')) = 'Obj_' || number || ' (' AND substr(name, length(name)) = ')');
