<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE" sourcelanguage="en">
<context>
    <name>Core</name>
    <message>
        <source>track</source>
        <translation>Verfolgen</translation>
    </message>
    <message>
        <source>filter</source>
        <translation>Filtern</translation>
    </message>
    <message>
        <source>integrate</source>
        <translation>Einfügen</translation>
    </message>
    <message>
        <source>raycast</source>
        <translation>Rendern</translation>
    </message>
    <message>
        <source>color</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>segment</source>
        <translation>Segmentieren</translation>
    </message>
    <message>
        <source>support</source>
        <translation>Auflagen</translation>
    </message>
    <message>
        <source>project</source>
        <translation>Projizieren</translation>
    </message>
    <message>
        <source>merge</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>update</source>
        <translation>Aktualisieren</translation>
    </message>
    <message>
        <source>discover</source>
        <translation>Entdecken</translation>
    </message>
    <message>
        <source>detect</source>
        <translation>Erkennen</translation>
    </message>
    <message>
        <source>m</source>
        <translation>m</translation>
    </message>
    <message>
        <source>frames</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>above 0: fragments join more readily (log-odds)</source>
        <translation>über 0: Fragmente verbinden sich leichter (Log-Odds)</translation>
    </message>
    <message>
        <source>minimum object size, longest side</source>
        <translation>kleinste Größe eines Objekts, längste Seite</translation>
    </message>
    <message>
        <source>maximum object size, longest side</source>
        <translation>größte Größe eines Objekts, längste Seite</translation>
    </message>
    <message>
        <source>frames with a stable size before a region becomes a candidate</source>
        <translation>Bilder mit gleichbleibender Größe, bevor eine Region ein Kandidat wird</translation>
    </message>
    <message>
        <source>below: recognised (0 = same picture, 2 = unrelated)</source>
        <translation>darunter: wiedererkannt (0 = gleiches Bild, 2 = nichts gemeinsam)</translation>
    </message>
    <message>
        <source>side of a voxel of the map (auto: by the footprint of a depth pixel)</source>
        <translation>Seitenlänge eines Voxels der Karte (auto: nach der Fläche eines Tiefenpixels)</translation>
    </message>
    <message>
        <source>farther readings are ignored (auto: 5 m, more in halls)</source>
        <translation>fernere Messwerte zählen nicht (auto: 5 m, in Hallen mehr)</translation>
    </message>
</context>
<context>
    <name>FileDialog</name>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>%1 file</source>
        <translation>%1-Datei</translation>
    </message>
</context>
<context>
    <name>NextSteps</name>
    <message numerus="yes">
        <source>Name %n found objects</source>
        <translation>
            <numerusform>%n gefundenes Objekt benennen</numerusform>
            <numerusform>%n gefundene Objekte benennen</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Check %n key frames</source>
        <translation>
            <numerusform>%n Schlüsselbild prüfen</numerusform>
            <numerusform>%n Schlüsselbilder prüfen</numerusform>
        </translation>
    </message>
    <message>
        <source>Export data set</source>
        <translation>Datensatz exportieren</translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message>
        <source>Add class “%1”</source>
        <translation>Klasse „%1“ hinzufügen</translation>
    </message>
    <message>
        <source>Rename class “%1” to “%2”</source>
        <translation>Klasse „%1“ in „%2“ umbenennen</translation>
    </message>
    <message>
        <source>Edit class “%1”</source>
        <translation>Klasse „%1“ bearbeiten</translation>
    </message>
    <message numerus="yes">
        <source>Merge %n classes</source>
        <translation>
            <numerusform>%n Klasse zusammenführen</numerusform>
            <numerusform>%n Klassen zusammenführen</numerusform>
        </translation>
    </message>
    <message>
        <source>Delete class</source>
        <translation>Klasse löschen</translation>
    </message>
    <message numerus="yes">
        <source>Delete %n classes</source>
        <translation>
            <numerusform>%n Klasse löschen</numerusform>
            <numerusform>%n Klassen löschen</numerusform>
        </translation>
    </message>
    <message>
        <source>Import classes from %1</source>
        <translation>Klassen aus %1 importieren</translation>
    </message>
    <message>
        <source>Merge “%1” with “%2”</source>
        <translation>„%1“ mit „%2“ zusammenführen</translation>
    </message>
    <message>
        <source>Rename “%1” to “%2”</source>
        <translation>„%1“ in „%2“ umbenennen</translation>
    </message>
    <message>
        <source>Remove the answer to “%1”</source>
        <translation>Antwort auf „%1“ entfernen</translation>
    </message>
    <message>
        <source>Answer “%1” with “%2”</source>
        <translation>„%1“ mit „%2“ beantworten</translation>
    </message>
    <message>
        <source>“%1” and “%2” are different</source>
        <translation>„%1“ und „%2“ sind verschieden</translation>
    </message>
</context>
<context>
    <name>RegionNames</name>
    <message>
        <source>%1 different things: %2</source>
        <translation>%1 verschiedene Dinge: %2</translation>
    </message>
</context>
<context>
    <name>TypedName</name>
    <message>
        <source>New class: %1</source>
        <translation>Neue Klasse: %1</translation>
    </message>
    <message>
        <source>Class: %1</source>
        <translation>Klasse: %1</translation>
    </message>
    <message>
        <source>Another %1: “%2”</source>
        <translation>Anderes Objekt der Klasse %1: „%2“</translation>
    </message>
    <message>
        <source>The same %1: “%2”</source>
        <translation>Dasselbe Objekt der Klasse %1: „%2“</translation>
    </message>
</context>
<context>
    <name>scantrove::AlikeList</name>
    <message>
        <source>Perhaps the same object</source>
        <translation>Vielleicht dasselbe Objekt</translation>
    </message>
    <message>
        <source>Comparing with the other objects…</source>
        <translation>Vergleich mit den anderen Objekten…</translation>
    </message>
    <message>
        <source>No other object of the catalogue looks like it.</source>
        <translation>Kein anderes Objekt des Katalogs sieht so aus.</translation>
    </message>
    <message>
        <source>Show the page of “%1”</source>
        <translation>Die Seite von „%1“ zeigen</translation>
    </message>
    <message>
        <source>very alike</source>
        <translation>sehr ähnlich</translation>
    </message>
    <message>
        <source>alike</source>
        <translation>ähnlich</translation>
    </message>
    <message>
        <source>A scan would take the one for the other.</source>
        <translation>Ein Scan würde das eine für das andere halten.</translation>
    </message>
    <message>
        <source>Their views resemble each other more than those of most objects.</source>
        <translation>Ihre Ansichten gleichen sich mehr als die der meisten Objekte.</translation>
    </message>
    <message>
        <source>The same object</source>
        <translation>Dasselbe Objekt</translation>
    </message>
    <message>
        <source>Merge the two; a name that you gave stays</source>
        <translation>Beide zusammenführen; ein gegebener Name bleibt</translation>
    </message>
    <message>
        <source>Different</source>
        <translation>Verschieden</translation>
    </message>
    <message>
        <source>Do not suggest this one again in this catalogue</source>
        <translation>Dieses in diesem Katalog nicht wieder vorschlagen</translation>
    </message>
</context>
<context>
    <name>scantrove::CameraDialog</name>
    <message>
        <source>Scan &amp;one object</source>
        <translation>Nur &amp;ein Objekt scannen</translation>
    </message>
    <message>
        <source>Scan what stands near the middle of the first image alone, on a turntable or in a hand. The surface below it and the room are left out.</source>
        <translation>Nur das scannen, was nahe der Mitte des ersten Bildes steht, auf einem Drehteller oder in der Hand. Die Fläche darunter und der Raum bleiben weg.</translation>
    </message>
    <message>
        <source>Choose a camera</source>
        <translation>Kamera wählen</translation>
    </message>
    <message>
        <source>Cameras</source>
        <translation>Kameras</translation>
    </message>
    <message>
        <source>&amp;Start scan</source>
        <translation>Scan &amp;starten</translation>
    </message>
    <message>
        <source>&amp;Refresh</source>
        <translation>&amp;Aktualisieren</translation>
    </message>
    <message>
        <source>&lt;b&gt;No depth camera was found.&lt;/b&gt;&lt;br&gt;%1</source>
        <translation>&lt;b&gt;Keine Tiefenkamera gefunden.&lt;/b&gt;&lt;br&gt;%1</translation>
    </message>
    <message>
        <source>Depth cameras on this computer:</source>
        <translation>Tiefenkameras an diesem Rechner:</translation>
    </message>
    <message>
        <source>Virtual test camera with a test pattern</source>
        <translation>Virtuelle Testkamera mit einem Testbild</translation>
    </message>
</context>
<context>
    <name>scantrove::CatalogueEditor</name>
    <message>
        <source>The object was deleted meanwhile, so it cannot be named “%1”. Undo the deletion and press Return again, or press Escape to cancel.</source>
        <translation>Das Objekt wurde inzwischen gelöscht und kann nicht „%1“ heißen. Das Löschen rückgängig machen und noch einmal Return drücken, oder mit Escape abbrechen.</translation>
    </message>
    <message>
        <source>Rename “%1” to “%2”</source>
        <translation>„%1“ in „%2“ umbenennen</translation>
    </message>
    <message numerus="yes">
        <source>Confirm %n objects</source>
        <translation>
            <numerusform>%n Objekt bestätigen</numerusform>
            <numerusform>%n Objekte bestätigen</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Unconfirm %n objects</source>
        <translation>
            <numerusform>Bestätigung von %n Objekt aufheben</numerusform>
            <numerusform>Bestätigung von %n Objekten aufheben</numerusform>
        </translation>
    </message>
    <message>
        <source>Confirm object</source>
        <translation>Objekt bestätigen</translation>
    </message>
    <message>
        <source>Unconfirm object</source>
        <translation>Bestätigung des Objekts aufheben</translation>
    </message>
    <message>
        <source>Delete object</source>
        <translation>Objekt löschen</translation>
    </message>
    <message numerus="yes">
        <source>Delete %n objects</source>
        <translation>
            <numerusform>%n Objekt löschen</numerusform>
            <numerusform>%n Objekte löschen</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Merge %n objects</source>
        <translation>
            <numerusform>%n Objekt zusammenführen</numerusform>
            <numerusform>%n Objekte zusammenführen</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ClassDialog</name>
    <message>
        <source>Classes</source>
        <translation>Klassen</translation>
    </message>
    <message>
        <source>Id</source>
        <translation>Id</translation>
    </message>
    <message>
        <source>Colour</source>
        <translation>Farbe</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Supercategory</source>
        <translation>Oberklasse</translation>
    </message>
    <message>
        <source>Attributes</source>
        <translation>Merkmale</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>Objekte</translation>
    </message>
    <message>
        <source>What the class asks about its objects, such as: material: wood, steel; broken: yes/no; remark</source>
        <translation>Was die Klasse von ihren Objekten wissen will, zum Beispiel: Material: Holz, Stahl; kaputt: yes/no; Bemerkung</translation>
    </message>
    <message>
        <source>&amp;Add…</source>
        <translation>&amp;Hinzufügen…</translation>
    </message>
    <message>
        <source>Add a class</source>
        <translation>Eine Klasse hinzufügen</translation>
    </message>
    <message>
        <source>Add class</source>
        <translation>Klasse hinzufügen</translation>
    </message>
    <message>
        <source>Name of the class</source>
        <translation>Name der Klasse</translation>
    </message>
    <message>
        <source>&amp;Merge</source>
        <translation>&amp;Zusammenführen</translation>
    </message>
    <message>
        <source>The selected classes become the one that is current</source>
        <translation>Die ausgewählten Klassen werden zu der, auf der die Markierung steht</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>Delete classes that no object has</source>
        <translation>Klassen löschen, die kein Objekt hat</translation>
    </message>
    <message>
        <source>&amp;Import…</source>
        <translation>&amp;Importieren…</translation>
    </message>
    <message>
        <source>Add and update classes from a JSON or CSV file</source>
        <translation>Klassen aus einer JSON- oder CSV-Datei hinzufügen und aktualisieren</translation>
    </message>
    <message>
        <source>List of classes</source>
        <translation>Klassenliste</translation>
    </message>
    <message>
        <source>Lists of classes (*.json *.csv)</source>
        <translation>Klassenlisten (*.json *.csv)</translation>
    </message>
    <message>
        <source>&amp;Export…</source>
        <translation>&amp;Exportieren…</translation>
    </message>
    <message>
        <source>Write all classes to a new JSON or CSV file</source>
        <translation>Alle Klassen in eine neue JSON- oder CSV-Datei schreiben</translation>
    </message>
    <message>
        <source>New list of classes</source>
        <translation>Neue Klassenliste</translation>
    </message>
    <message>
        <source>&amp;Close</source>
        <translation>&amp;Schließen</translation>
    </message>
    <message>
        <source>Double click to change the colour</source>
        <translation>Doppelklick ändert die Farbe</translation>
    </message>
    <message>
        <source>%1 added, %2 updated, %3 unchanged.</source>
        <translation>%1 hinzugefügt, %2 aktualisiert, %3 unverändert.</translation>
    </message>
    <message numerus="yes">
        <source>%n classes written to %1.</source>
        <translation>
            <numerusform>%n Klasse in %1 geschrieben.</numerusform>
            <numerusform>%n Klassen in %1 geschrieben.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ClipTool</name>
    <message>
        <source>Clip plane at %1 m — Ctrl + wheel moves it, X removes it</source>
        <translation>Schnittebene bei %1 m — Strg + Mausrad verschiebt sie, X entfernt sie</translation>
    </message>
</context>
<context>
    <name>scantrove::ColorPanel</name>
    <message>
        <source>Colour and objects</source>
        <translation>Farbe und Objekte</translation>
    </message>
    <message>
        <source>The colour image. White rectangles: discovered objects. Cyan names: recognised objects. White names: new objects. Yellow: selected in the object list. Dashed: candidates; O marks one as object.</source>
        <translation>Das Farbbild. Weiße Rechtecke: entdeckte Objekte. Türkise Namen: wiedererkannte Objekte. Weiße Namen: neue Objekte. Gelb: in der Objektliste ausgewählt. Gestrichelt: Kandidaten; O markiert einen als Objekt.</translation>
    </message>
    <message>
        <source>Camera lost. Point it at this view, or at any place that it has seen</source>
        <translation>Kamera verloren. Auf diese Ansicht richten oder auf eine Stelle, die sie schon gesehen hat</translation>
    </message>
</context>
<context>
    <name>scantrove::CoverageGuide</name>
    <message>
        <source>Show where to m&amp;ove</source>
        <translation>&amp;Weg der Kamera zeigen</translation>
    </message>
    <message>
        <source>Shift+G</source>
        <translation>Shift+G</translation>
    </message>
    <message>
        <source>Show with an arrow where to move the camera to see the unseen sides of the selection (%1)</source>
        <translation>Mit einem Pfeil zeigen, wohin sich die Kamera bewegen muss, um die ungesehenen Seiten der Auswahl zu sehen (%1)</translation>
    </message>
    <message>
        <source>Move here</source>
        <translation>Hierher bewegen</translation>
    </message>
</context>
<context>
    <name>scantrove::DepthPanel</name>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
</context>
<context>
    <name>scantrove::DockArrangement</name>
    <message>
        <source>Close (%1)</source>
        <translation>Schließen (%1)</translation>
    </message>
</context>
<context>
    <name>scantrove::ExportChoicesPanel</name>
    <message>
        <source>All &amp;stored frames, not only key frames</source>
        <translation>Alle &amp;gespeicherten Bilder, nicht nur Schlüsselbilder</translation>
    </message>
    <message>
        <source>Include &amp;background and rejected regions</source>
        <translation>Auch &amp;Hintergrund und verworfene Regionen</translation>
    </message>
    <message>
        <source>Include &amp;unfit frames</source>
        <translation>Auch &amp;ungeeignete Bilder</translation>
    </message>
    <message>
        <source>All objects and names</source>
        <translation>Alle Objekte und Namen</translation>
    </message>
    <message>
        <source>What has a name</source>
        <translation>Was einen Namen hat</translation>
    </message>
    <message>
        <source>Confirmed objects</source>
        <translation>Bestätigte Objekte</translation>
    </message>
    <message>
        <source>Labels</source>
        <translation>Labels</translation>
    </message>
    <message>
        <source>Count them</source>
        <translation>Zählen</translation>
    </message>
    <message>
        <source>Mark as regions to ignore</source>
        <translation>Als zu ignorierende Regionen markieren</translation>
    </message>
    <message>
        <source>Leave them</source>
        <translation>Nicht beachten</translation>
    </message>
    <message>
        <source>Objects without a label</source>
        <translation>Objekte ohne Label</translation>
    </message>
    <message>
        <source>Objects that images show and that are not exported. COCO, masks and VOC can mark them, so that a learner does not take them for background.</source>
        <translation>Objekte, die auf Bildern zu sehen sind und nicht exportiert werden. COCO, Masken und VOC können sie markieren, damit ein Lernverfahren sie nicht für Hintergrund hält.</translation>
    </message>
    <message>
        <source>Classes</source>
        <translation>Klassen</translation>
    </message>
    <message>
        <source>Only the ticked classes are exported; without ticks all are</source>
        <translation>Nur die angehakten Klassen werden exportiert; ohne Haken alle</translation>
    </message>
    <message>
        <source> % of the frames, the last ones</source>
        <translation> % der Bilder, die letzten</translation>
    </message>
    <message>
        <source>Validation</source>
        <translation>Validierung</translation>
    </message>
    <message>
        <source>License</source>
        <translation>Lizenz</translation>
    </message>
    <message>
        <source>none, or for example CC BY 4.0</source>
        <translation>keine, oder zum Beispiel CC BY 4.0</translation>
    </message>
    <message>
        <source>Written into the data set&apos;s README and LICENSE.txt</source>
        <translation>Steht dann in README und LICENSE.txt des Datensatzes</translation>
    </message>
    <message>
        <source>Frames that are blurred, or whose depth and colour do not fit</source>
        <translation>Bilder, die verwischt sind oder deren Tiefe und Farbe nicht zusammenpassen</translation>
    </message>
    <message>
        <source>L&amp;abels</source>
        <translation>L&amp;abels</translation>
    </message>
    <message>
        <source>U&amp;nlabelled</source>
        <translation>Oh&amp;ne Label</translation>
    </message>
    <message>
        <source>&amp;Validation</source>
        <translation>&amp;Validierung</translation>
    </message>
    <message>
        <source>&amp;License</source>
        <translation>&amp;Lizenz</translation>
    </message>
    <message>
        <source>Only chec&amp;ked key frames</source>
        <translation>Nur geprüfte S&amp;chlüsselbilder</translation>
    </message>
    <message>
        <source>&amp;Textures</source>
        <translation>&amp;Texturen</translation>
    </message>
    <message>
        <source>Only key frames that you have checked in the review</source>
        <translation>Nur Schlüsselbilder, die in der Durchsicht als geprüft markiert sind</translation>
    </message>
    <message>
        <source>OBJ and GLB show the colour images of the key frames</source>
        <translation>OBJ und GLB zeigen die Farbbilder der Schlüsselbilder</translation>
    </message>
</context>
<context>
    <name>scantrove::ExportDialog</name>
    <message>
        <source>COCO instances: images and one JSON file with masks (pycocotools, CVAT, FiftyOne)</source>
        <translation>COCO-Instanzen: Bilder und eine JSON-Datei mit Masken (pycocotools, CVAT, FiftyOne)</translation>
    </message>
    <message>
        <source>BOP: colour, depth, masks, poses and models of the objects (bop_toolkit)</source>
        <translation>BOP: Farbe, Tiefe, Masken, Posen und Modelle der Objekte (bop_toolkit)</translation>
    </message>
    <message>
        <source>YOLO segments: outlines as polygons (ultralytics)</source>
        <translation>YOLO-Segmente: Umrisse als Polygone (ultralytics)</translation>
    </message>
    <message>
        <source>Masks: a 16-bit image of region numbers per frame, and a list of names</source>
        <translation>Masken: je Bild ein 16-Bit-Bild der Regionsnummern, und eine Namensliste</translation>
    </message>
    <message>
        <source>Pascal VOC: images, boxes as XML, and palette images (torchvision, CVAT)</source>
        <translation>Pascal VOC: Bilder, Rahmen als XML und Palettenbilder (torchvision, CVAT)</translation>
    </message>
    <message>
        <source>Label Studio: images, and tasks with brush masks to import</source>
        <translation>Label Studio: Bilder und Aufgaben mit Pinselmasken zum Importieren</translation>
    </message>
    <message>
        <source>3D boxes: upright boxes with the cloud (labelCloud) and for each frame (SUN RGB-D)</source>
        <translation>3D-Quader: aufrechte Quader mit der Punktwolke (labelCloud) und für jedes Bild (SUN RGB-D)</translation>
    </message>
    <message>
        <source>FoundationPose: a folder per object with images, depth, masks, poses and its model</source>
        <translation>FoundationPose: je Objekt ein Ordner mit Bildern, Tiefe, Masken, Posen und seinem Modell</translation>
    </message>
    <message>
        <source>PLY: the labelled coloured cloud (CloudCompare, MeshLab)</source>
        <translation>PLY: die beschriftete farbige Punktwolke (CloudCompare, MeshLab)</translation>
    </message>
    <message>
        <source>PCD: the labelled coloured cloud (PCL)</source>
        <translation>PCD: die beschriftete farbige Punktwolke (PCL)</translation>
    </message>
    <message>
        <source>Meshes: the scene and each object as PLY, OBJ and GLB (Blender, MeshLab)</source>
        <translation>Netze: die Szene und jedes Objekt als PLY, OBJ und GLB (Blender, MeshLab)</translation>
    </message>
    <message>
        <source>TUM: the trajectory of the camera (evo)</source>
        <translation>TUM: die Bahn der Kamera (evo)</translation>
    </message>
    <message>
        <source>ScanNet: mesh, segments and objects (ScanNet&apos;s tools)</source>
        <translation>ScanNet: Netz, Segmente und Objekte (Werkzeuge von ScanNet)</translation>
    </message>
    <message numerus="yes">
        <source>%n scans</source>
        <translation>
            <numerusform>%n Scan</numerusform>
            <numerusform>%n Scans</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n images</source>
        <translation>
            <numerusform>%n Bild</numerusform>
            <numerusform>%n Bilder</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n objects</source>
        <translation>
            <numerusform>%n Objekt</numerusform>
            <numerusform>%n Objekte</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n masks</source>
        <translation>
            <numerusform>%n Maske</numerusform>
            <numerusform>%n Masken</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 points</source>
        <translation>%1 Punkte</translation>
    </message>
    <message>
        <source>%1 MB</source>
        <translation>%1 MB</translation>
    </message>
    <message numerus="yes">
        <source>
%n frames are not included: %1</source>
        <translation>
            <numerusform>
%n Bild ist nicht enthalten: %1</numerusform>
            <numerusform>
%n Bilder sind nicht enthalten: %1</numerusform>
        </translation>
    </message>
    <message>
        <source>Co&amp;unt</source>
        <translation>&amp;Zählen</translation>
    </message>
    <message>
        <source>&amp;Export</source>
        <translation>&amp;Exportieren</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Schließen</translation>
    </message>
    <message>
        <source>Open the &amp;folder</source>
        <translation>Ordner ö&amp;ffnen</translation>
    </message>
    <message>
        <source>Export data set</source>
        <translation>Datensatz exportieren</translation>
    </message>
    <message>
        <source>Format</source>
        <translation>Format</translation>
    </message>
    <message>
        <source>Counts images, instances and pixels of each class, and writes nothing</source>
        <translation>Zählt Bilder, Instanzen und Pixel jeder Klasse und schreibt nichts</translation>
    </message>
    <message>
        <source>F&amp;ormat</source>
        <translation>F&amp;ormat</translation>
    </message>
    <message>
        <source>Save to</source>
        <translation>Speichern in</translation>
    </message>
    <message numerus="yes">
        <source>%n scans of the project. Count shows what they hold.</source>
        <translation>
            <numerusform>%n Scan des Projekts. Zählen zeigt, was er enthält.</numerusform>
            <numerusform>%n Scans des Projekts. Zählen zeigt, was sie enthalten.</numerusform>
        </translation>
    </message>
    <message>
        <source>Nothing would be exported. Name some regions first, or choose other labels.</source>
        <translation>Es würde nichts exportiert. Zuerst einige Regionen benennen oder andere Labels wählen.</translation>
    </message>
    <message>
        <source>%1, %2, about %3 MB</source>
        <translation>%1, %2, etwa %3 MB</translation>
    </message>
    <message>
        <source>Counting…</source>
        <translation>Zählen läuft…</translation>
    </message>
    <message>
        <source>Exporting…</source>
        <translation>Export läuft…</translation>
    </message>
    <message>
        <source>The data set would hold %1</source>
        <translation>Der Datensatz enthielte %1</translation>
    </message>
    <message>
        <source>Exported %1 to %2</source>
        <translation>%1 nach %2 exportiert</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Abbrechen</translation>
    </message>
</context>
<context>
    <name>scantrove::ExportFolderField</name>
    <message>
        <source>Folder</source>
        <translation>Ordner</translation>
    </message>
    <message>
        <source>A new or an empty folder, or that of an earlier data set of the same format, which is replaced if nobody has changed it</source>
        <translation>Ein neuer oder leerer Ordner, oder der eines früheren Datensatzes im selben Format, den niemand geändert hat: er wird ersetzt</translation>
    </message>
    <message>
        <source>&amp;Choose…</source>
        <translation>&amp;Wählen…</translation>
    </message>
    <message>
        <source>Folder of the data set</source>
        <translation>Ordner des Datensatzes</translation>
    </message>
</context>
<context>
    <name>scantrove::ExportSampleView</name>
    <message>
        <source>An image of the data set with its masks</source>
        <translation>Ein Bild des Datensatzes mit seinen Masken</translation>
    </message>
    <message>
        <source>Previous image (Page up)</source>
        <translation>Voriges Bild (Bild aufwärts)</translation>
    </message>
    <message>
        <source>Previous image</source>
        <translation>Voriges Bild</translation>
    </message>
    <message>
        <source>Next image (Page down)</source>
        <translation>Nächstes Bild (Bild abwärts)</translation>
    </message>
    <message>
        <source>Next image</source>
        <translation>Nächstes Bild</translation>
    </message>
    <message>
        <source>This image is not included: %1</source>
        <translation>Dieses Bild ist nicht enthalten: %1</translation>
    </message>
    <message numerus="yes">
        <source>Frame %1 — %2 of %3 — %n masks</source>
        <translation>
            <numerusform>Bild %1 — %2 von %3 — %n Maske</numerusform>
            <numerusform>Bild %1 — %2 von %3 — %n Masken</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ExportScansPanel</name>
    <message>
        <source>&amp;This scan</source>
        <translation>Diese&amp;r Scan</translation>
    </message>
    <message>
        <source>Scans of the &amp;project</source>
        <translation>Scans des &amp;Projekts</translation>
    </message>
    <message>
        <source>Scans</source>
        <translation>Scans</translation>
    </message>
    <message>
        <source>validation</source>
        <translation>Validierung</translation>
    </message>
    <message>
        <source>test</source>
        <translation>Test</translation>
    </message>
    <message>
        <source> % %1</source>
        <translation> % %1</translation>
    </message>
    <message>
        <source>Share of the scans. The frames of a scan are never divided.</source>
        <translation>Anteil der Scans. Die Bilder eines Scans werden nie aufgeteilt.</translation>
    </message>
    <message>
        <source>draw </source>
        <translation>Ziehung </translation>
    </message>
    <message>
        <source>Draw</source>
        <translation>Ziehung</translation>
    </message>
    <message>
        <source>Another number draws other scans; the same number the same ones</source>
        <translation>Eine andere Zahl zieht andere Scans; dieselbe Zahl dieselben</translation>
    </message>
    <message>
        <source>Tick the scans to export.</source>
        <translation>Die Scans anhaken, die exportiert werden sollen.</translation>
    </message>
    <message>
        <source>Validation and test are more than all scans.</source>
        <translation>Validierung und Test sind mehr als alle Scans.</translation>
    </message>
    <message>
        <source>%1 % training</source>
        <translation>%1 % Training</translation>
    </message>
</context>
<context>
    <name>scantrove::ExportStatisticsView</name>
    <message>
        <source>Split</source>
        <translation>Teil</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Klasse</translation>
    </message>
    <message>
        <source>Images</source>
        <translation>Bilder</translation>
    </message>
    <message>
        <source>Instances</source>
        <translation>Instanzen</translation>
    </message>
    <message>
        <source>Pixels</source>
        <translation>Pixel</translation>
    </message>
    <message>
        <source>Counts of classes</source>
        <translation>Zahlen der Klassen</translation>
    </message>
    <message>
        <source>all</source>
        <translation>alle</translation>
    </message>
</context>
<context>
    <name>scantrove::FramePanels</name>
    <message>
        <source>Depth, camera</source>
        <translation>Tiefe, Kamera</translation>
    </message>
    <message>
        <source>Depth as the camera measured it in this frame.</source>
        <translation>Tiefe, wie die Kamera sie in diesem Bild gemessen hat.</translation>
    </message>
    <message>
        <source>Depth, fused</source>
        <translation>Tiefe, fusioniert</translation>
    </message>
    <message>
        <source>Depth of the fused map from the same pose, with fewer holes and less noise.</source>
        <translation>Tiefe der fusionierten Karte aus derselben Pose, mit weniger Löchern und Rauschen.</translation>
    </message>
    <message>
        <source>Segments, this frame</source>
        <translation>Segmente, dieses Bild</translation>
    </message>
    <message>
        <source>Segments of this frame alone, split at concave edges. Their colours change from frame to frame.</source>
        <translation>Segmente dieses einen Bildes, an konkaven Kanten geteilt. Ihre Farben wechseln von Bild zu Bild.</translation>
    </message>
    <message>
        <source>Regions, merged</source>
        <translation>Regionen, verbunden</translation>
    </message>
    <message>
        <source>Segments merged over all frames. A region has the same colour here and in the 3D view. A selected object darkens the other regions.</source>
        <translation>Segmente, über alle Bilder verbunden. Eine Region hat hier und in der 3D-Ansicht dieselbe Farbe. Ein ausgewähltes Objekt dunkelt die anderen Regionen ab.</translation>
    </message>
    <message>
        <source>This frame has no colour image.</source>
        <translation>Dieses Bild hat kein Farbbild.</translation>
    </message>
</context>
<context>
    <name>scantrove::GuideOpener</name>
    <message>
        <source>&amp;Guide</source>
        <translation>&amp;Anleitung</translation>
    </message>
    <message>
        <source>Ctrl+F1</source>
        <translation>Ctrl+F1</translation>
    </message>
    <message>
        <source>Show the guide in the browser (Ctrl+F1)</source>
        <translation>Die Anleitung im Browser zeigen (Strg+F1)</translation>
    </message>
    <message>
        <source>The guide is not installed with this program. It is in the source as docs/guide/index.md; packaging/guide builds it.</source>
        <translation>Die Anleitung ist mit diesem Programm nicht installiert. Sie liegt im Quelltext als docs/guide/index.md; packaging/guide erzeugt sie.</translation>
    </message>
    <message>
        <source>No program shows the guide. Open this file with a browser: %1</source>
        <translation>Kein Programm zeigt die Anleitung. Diese Datei mit einem Browser öffnen: %1</translation>
    </message>
</context>
<context>
    <name>scantrove::HelpDialog</name>
    <message>
        <source>Keys and mouse</source>
        <translation>Tasten und Maus</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Scan</translation>
    </message>
    <message>
        <source>Ctrl+O, Ctrl+Shift+O, Ctrl+Alt+O</source>
        <translation>Strg+O, Strg+Umschalt+O, Strg+Alt+O</translation>
    </message>
    <message>
        <source>Open a folder, a recording, or either with options</source>
        <translation>Einen Ordner oder eine Aufnahme öffnen, auch mit Optionen</translation>
    </message>
    <message>
        <source>Ctrl+K</source>
        <translation>Strg+K</translation>
    </message>
    <message>
        <source>Scan with a camera</source>
        <translation>Mit einer Kamera scannen</translation>
    </message>
    <message>
        <source>Ctrl+J, Ctrl+N</source>
        <translation>Strg+J, Strg+N</translation>
    </message>
    <message>
        <source>Open a project; make a new one</source>
        <translation>Ein Projekt öffnen; ein neues anlegen</translation>
    </message>
    <message>
        <source>Space</source>
        <translation>Leertaste</translation>
    </message>
    <message>
        <source>Pause, resume</source>
        <translation>Anhalten, fortsetzen</translation>
    </message>
    <message>
        <source>N</source>
        <translation>N</translation>
    </message>
    <message>
        <source>Step one frame</source>
        <translation>Ein Bild weiter</translation>
    </message>
    <message>
        <source>Ctrl+R</source>
        <translation>Strg+R</translation>
    </message>
    <message>
        <source>Scan from the beginning</source>
        <translation>Von vorn scannen</translation>
    </message>
    <message>
        <source>Ctrl+.</source>
        <translation>Strg+.</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Stoppen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+S, Ctrl+Shift+R</source>
        <translation>Strg+Umschalt+S, Strg+Umschalt+R</translation>
    </message>
    <message>
        <source>Skip the refinement; refine later</source>
        <translation>Die Verfeinerung überspringen; später verfeinern</translation>
    </message>
    <message>
        <source>Ctrl+Alt+R</source>
        <translation>Strg+Alt+R</translation>
    </message>
    <message>
        <source>Continue the saved scan with more frames</source>
        <translation>Den gespeicherten Scan mit weiteren Bildern fortführen</translation>
    </message>
    <message>
        <source>Ctrl+W</source>
        <translation>Strg+W</translation>
    </message>
    <message>
        <source>Close scan</source>
        <translation>Scan schließen</translation>
    </message>
    <message>
        <source>Objects (with the list in focus)</source>
        <translation>Objekte (wenn die Liste den Fokus hat)</translation>
    </message>
    <message>
        <source>Ctrl+L</source>
        <translation>Strg+L</translation>
    </message>
    <message>
        <source>Go to the object list</source>
        <translation>Zur Objektliste</translation>
    </message>
    <message>
        <source>Ctrl+F</source>
        <translation>Strg+F</translation>
    </message>
    <message>
        <source>Find an object by name or class</source>
        <translation>Ein Objekt nach Name oder Klasse suchen</translation>
    </message>
    <message>
        <source>F2</source>
        <translation>F2</translation>
    </message>
    <message>
        <source>Rename</source>
        <translation>Umbenennen</translation>
    </message>
    <message>
        <source>Return</source>
        <translation>Return</translation>
    </message>
    <message>
        <source>Confirm, unconfirm</source>
        <translation>Bestätigen, Bestätigung aufheben</translation>
    </message>
    <message>
        <source>Del</source>
        <translation>Entf</translation>
    </message>
    <message>
        <source>Delete</source>
        <translation>Löschen</translation>
    </message>
    <message>
        <source>M</source>
        <translation>M</translation>
    </message>
    <message>
        <source>Merge the selected objects into one</source>
        <translation>Die ausgewählten Objekte zusammenführen</translation>
    </message>
    <message>
        <source>Ctrl+Z, Ctrl+Shift+Z</source>
        <translation>Strg+Z, Strg+Umschalt+Z</translation>
    </message>
    <message>
        <source>Undo, redo</source>
        <translation>Rückgängig, wiederholen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+L</source>
        <translation>Strg+Umschalt+L</translation>
    </message>
    <message>
        <source>Classes</source>
        <translation>Klassen</translation>
    </message>
    <message>
        <source>Regions (in the 3D view and in the images)</source>
        <translation>Regionen (in der 3D-Ansicht und in den Bildern)</translation>
    </message>
    <message>
        <source>Click, Ctrl+click</source>
        <translation>Klick, Strg+Klick</translation>
    </message>
    <message>
        <source>Select a region; select another one as well</source>
        <translation>Eine Region auswählen; noch eine dazu</translation>
    </message>
    <message>
        <source>Ctrl+drag (images: drag)</source>
        <translation>Strg+Ziehen (Bilder: Ziehen)</translation>
    </message>
    <message>
        <source>Select all regions in a rectangle</source>
        <translation>Alle Regionen in einem Rechteck auswählen</translation>
    </message>
    <message>
        <source>Tab, Shift+Tab</source>
        <translation>Tab, Umschalt+Tab</translation>
    </message>
    <message>
        <source>Next and previous region by size</source>
        <translation>Nächste und vorige Region der Größe nach</translation>
    </message>
    <message>
        <source>Return, double click</source>
        <translation>Return, Doppelklick</translation>
    </message>
    <message>
        <source>Name the region</source>
        <translation>Die Region benennen</translation>
    </message>
    <message>
        <source>1 … 9</source>
        <translation>1 … 9</translation>
    </message>
    <message>
        <source>Give it a recent name</source>
        <translation>Einen zuletzt benutzten Namen geben</translation>
    </message>
    <message>
        <source>Return, Shift+Return, Tab while naming</source>
        <translation>Return, Umschalt+Return, Tab beim Benennen</translation>
    </message>
    <message>
        <source>If another object has the name: another one; the same one; choose</source>
        <translation>Wenn ein anderes Objekt so heißt: ein anderes; dasselbe; wählen</translation>
    </message>
    <message>
        <source>J</source>
        <translation>J</translation>
    </message>
    <message>
        <source>Join</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>C, then two strokes or clicks</source>
        <translation>C, dann zwei Striche oder Klicks</translation>
    </message>
    <message>
        <source>Split: draw over one part, then over the other</source>
        <translation>Teilen: über einen Teil zeichnen, dann über den anderen</translation>
    </message>
    <message>
        <source>C, then one stroke or click, Return</source>
        <translation>C, dann ein Strich oder Klick, Return</translation>
    </message>
    <message>
        <source>Split off what has other colours around it</source>
        <translation>Abteilen, was von anderen Farben umgeben ist</translation>
    </message>
    <message>
        <source>Shift, Return, Escape while splitting</source>
        <translation>Umschalt, Return, Escape beim Teilen</translation>
    </message>
    <message>
        <source>Add a stroke; accept; cancel</source>
        <translation>Strich hinzufügen; annehmen; abbrechen</translation>
    </message>
    <message>
        <source>+ and −</source>
        <translation>+ und −</translation>
    </message>
    <message>
        <source>Split further, merge with neighbour (without a selection: zoom)</source>
        <translation>Weiter teilen, mit Nachbar vereinen (ohne Auswahl: zoomen)</translation>
    </message>
    <message>
        <source>B, O, Del</source>
        <translation>B, O, Entf</translation>
    </message>
    <message>
        <source>Background; mark as object; not an object</source>
        <translation>Hintergrund; als Objekt markieren; kein Objekt</translation>
    </message>
    <message>
        <source>Ctrl+B</source>
        <translation>Strg+B</translation>
    </message>
    <message>
        <source>Mark all supports as background</source>
        <translation>Alle Auflagen als Hintergrund markieren</translation>
    </message>
    <message>
        <source>A, Shift+A, Backspace</source>
        <translation>A, Umschalt+A, Rücktaste</translation>
    </message>
    <message>
        <source>Suggestion: accept; accept all; reject</source>
        <translation>Vorschlag: annehmen; alle annehmen; ablehnen</translation>
    </message>
    <message>
        <source>.</source>
        <translation>.</translation>
    </message>
    <message>
        <source>Zoom to selection</source>
        <translation>Auf Auswahl zoomen</translation>
    </message>
    <message>
        <source>Escape</source>
        <translation>Escape</translation>
    </message>
    <message>
        <source>Deselect</source>
        <translation>Auswahl aufheben</translation>
    </message>
    <message>
        <source>Page up, Page down</source>
        <translation>Bild aufwärts, Bild abwärts</translation>
    </message>
    <message>
        <source>Previous, next key frame (after the scan)</source>
        <translation>Voriges, nächstes Schlüsselbild (nach dem Scan)</translation>
    </message>
    <message>
        <source>K, Shift+K, Ctrl+Shift+K</source>
        <translation>K, Umschalt+K, Strg+Umschalt+K</translation>
    </message>
    <message>
        <source>Key frame: checked; left out of data sets; open again</source>
        <translation>Schlüsselbild: geprüft; in Datensätzen ausgelassen; wieder offen</translation>
    </message>
    <message>
        <source>Ctrl+Page down, Ctrl+Page up</source>
        <translation>Strg+Bild abwärts, Strg+Bild aufwärts</translation>
    </message>
    <message>
        <source>Next, previous open key frame</source>
        <translation>Nächstes, voriges offenes Schlüsselbild</translation>
    </message>
    <message>
        <source>Ctrl+E</source>
        <translation>Strg+E</translation>
    </message>
    <message>
        <source>Export data set</source>
        <translation>Datensatz exportieren</translation>
    </message>
    <message>
        <source>Ctrl+Shift+P</source>
        <translation>Strg+Umschalt+P</translation>
    </message>
    <message>
        <source>Save picture of the scan</source>
        <translation>Bild des Scans speichern</translation>
    </message>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>Drag, arrow keys</source>
        <translation>Ziehen, Pfeiltasten</translation>
    </message>
    <message>
        <source>Turn</source>
        <translation>Drehen</translation>
    </message>
    <message>
        <source>Shift+drag, Shift+arrow keys</source>
        <translation>Umschalt+Ziehen, Umschalt+Pfeiltasten</translation>
    </message>
    <message>
        <source>Move</source>
        <translation>Verschieben</translation>
    </message>
    <message>
        <source>Wheel, + and −</source>
        <translation>Mausrad, + und −</translation>
    </message>
    <message>
        <source>Zoom</source>
        <translation>Zoomen</translation>
    </message>
    <message>
        <source>Double click on the background, Home, Ctrl+0</source>
        <translation>Doppelklick auf den Hintergrund, Pos1, Strg+0</translation>
    </message>
    <message>
        <source>Show all</source>
        <translation>Alles zeigen</translation>
    </message>
    <message>
        <source>F</source>
        <translation>F</translation>
    </message>
    <message>
        <source>Follow the camera</source>
        <translation>Der Kamera folgen</translation>
    </message>
    <message>
        <source>G, Shift+G</source>
        <translation>G, Umschalt+G</translation>
    </message>
    <message>
        <source>Ground grid; show where to move</source>
        <translation>Bodengitter; Weg der Kamera zeigen</translation>
    </message>
    <message>
        <source>Alt+1 … Alt+5, R</source>
        <translation>Alt+1 … Alt+5, R</translation>
    </message>
    <message>
        <source>Colour by scene, regions, both, direction, height; next mode</source>
        <translation>Färben nach Szene, Regionen, beidem, Richtung, Höhe; nächster Modus</translation>
    </message>
    <message>
        <source>Shift+N</source>
        <translation>Umschalt+N</translation>
    </message>
    <message>
        <source>Names of the regions</source>
        <translation>Namen der Regionen</translation>
    </message>
    <message>
        <source>Shift+B</source>
        <translation>Umschalt+B</translation>
    </message>
    <message>
        <source>Background shown, dimmed, hidden</source>
        <translation>Hintergrund sichtbar, abgedunkelt, verborgen</translation>
    </message>
    <message>
        <source>X, Ctrl+wheel</source>
        <translation>X, Strg+Mausrad</translation>
    </message>
    <message>
        <source>Clip plane, move the plane</source>
        <translation>Schnittebene, Ebene verschieben</translation>
    </message>
    <message>
        <source>T</source>
        <translation>T</translation>
    </message>
    <message>
        <source>Measure between two clicks</source>
        <translation>Zwischen zwei Klicks messen</translation>
    </message>
    <message>
        <source>Ctrl+Alt+1 … Ctrl+Alt+6</source>
        <translation>Strg+Alt+1 … Strg+Alt+6</translation>
    </message>
    <message>
        <source>View from front, back, left, right, top, bottom</source>
        <translation>Ansicht von vorn, hinten, links, rechts, oben, unten</translation>
    </message>
    <message>
        <source>Window</source>
        <translation>Fenster</translation>
    </message>
    <message>
        <source>Ctrl+1 … Ctrl+4</source>
        <translation>Strg+1 … Strg+4</translation>
    </message>
    <message>
        <source>Show or hide objects, current frame, settings, history</source>
        <translation>Objekte, aktuelles Bild, Einstellungen, Verlauf zeigen oder verbergen</translation>
    </message>
    <message>
        <source>Click the title of an image, V</source>
        <translation>Klick auf den Titel eines Bildes, V</translation>
    </message>
    <message>
        <source>F11</source>
        <translation>F11</translation>
    </message>
    <message>
        <source>Presentation mode</source>
        <translation>Präsentation</translation>
    </message>
    <message>
        <source>?, F1</source>
        <translation>?, F1</translation>
    </message>
    <message>
        <source>Show these keys</source>
        <translation>Diese Tasten zeigen</translation>
    </message>
    <message>
        <source>Ctrl+Q</source>
        <translation>Strg+Q</translation>
    </message>
    <message>
        <source>Quit</source>
        <translation>Beenden</translation>
    </message>
    <message>
        <source>Image mode</source>
        <translation>Bildmodus</translation>
    </message>
    <message>
        <source>Ctrl+I, double click the title of an image</source>
        <translation>Strg+I, Doppelklick auf den Titel eines Bildes</translation>
    </message>
    <message>
        <source>Image mode on and off; show that image</source>
        <translation>Bildmodus ein und aus; dieses Bild zeigen</translation>
    </message>
    <message>
        <source>Wheel, Ctrl++, Ctrl+−, Ctrl+0</source>
        <translation>Mausrad, Strg++, Strg+−, Strg+0</translation>
    </message>
    <message>
        <source>Zoom; fit</source>
        <translation>Zoomen; einpassen</translation>
    </message>
    <message>
        <source>Middle drag, Space+drag</source>
        <translation>Mittlere Taste ziehen, Leertaste+Ziehen</translation>
    </message>
    <message>
        <source>Move the image</source>
        <translation>Das Bild verschieben</translation>
    </message>
    <message>
        <source>V, D</source>
        <translation>V, D</translation>
    </message>
    <message>
        <source>Next image; 3D view beside it</source>
        <translation>Nächstes Bild; 3D-Ansicht daneben</translation>
    </message>
    <message>
        <source>M, Shift+M</source>
        <translation>M, Umschalt+M</translation>
    </message>
    <message>
        <source>Masks filled, outlined, off; names</source>
        <translation>Masken gefüllt, als Umrisse, aus; Namen</translation>
    </message>
    <message>
        <source>S, P, E, L, W, H</source>
        <translation>S, P, E, L, W, H</translation>
    </message>
    <message>
        <source>Select, brush, eraser, polygon, magic edge, fill hole (in a key frame)</source>
        <translation>Auswählen, Pinsel, Radierer, Polygon, magische Kante, Loch füllen (in einem Schlüsselbild)</translation>
    </message>
    <message>
        <source>[ and ], Ctrl+wheel</source>
        <translation>[ und ], Strg+Mausrad</translation>
    </message>
    <message>
        <source>Size of the brush</source>
        <translation>Größe des Pinsels</translation>
    </message>
    <message>
        <source>Return, Backspace, Escape</source>
        <translation>Return, Rücktaste, Escape</translation>
    </message>
    <message>
        <source>Polygon: close, one corner back; drop what is drawn</source>
        <translation>Polygon: schließen, eine Ecke zurück; das Gezeichnete verwerfen</translation>
    </message>
    <message>
        <source>Ins</source>
        <translation>Einfg</translation>
    </message>
    <message>
        <source>Paint a new region</source>
        <translation>Eine neue Region malen</translation>
    </message>
    <message>
        <source>Enlarge it (twice: image mode)</source>
        <translation>Es vergrößern (doppelt: Bildmodus)</translation>
    </message>
    <message>
        <source>Ctrl+F1</source>
        <translation>Ctrl+F1</translation>
    </message>
    <message>
        <source>Show the guide in the browser</source>
        <translation>Die Anleitung im Browser zeigen</translation>
    </message>
    <message>
        <source>Ctrl+Return, double click a picture</source>
        <translation>Strg+Eingabe, Doppelklick auf ein Bild</translation>
    </message>
    <message>
        <source>Page of the object: views, 3D model, scans</source>
        <translation>Seite des Objekts: Ansichten, 3D-Modell, Scans</translation>
    </message>
</context>
<context>
    <name>scantrove::HistoryPanel</name>
    <message>
        <source>Original scan</source>
        <translation>Ursprünglicher Scan</translation>
    </message>
    <message>
        <source>Edits</source>
        <translation>Bearbeitungen</translation>
    </message>
    <message>
        <source>Click a step to return to it</source>
        <translation>Ein Klick auf einen Schritt kehrt zu ihm zurück</translation>
    </message>
</context>
<context>
    <name>scantrove::ImageCanvas</name>
    <message>
        <source>Image</source>
        <translation>Bild</translation>
    </message>
    <message>
        <source>The image of the current frame, in which masks are painted.</source>
        <translation>Das aktuelle Bild, in dem Masken gemalt werden.</translation>
    </message>
</context>
<context>
    <name>scantrove::ImageMode</name>
    <message>
        <source>Select the region whose mask is to be reset.</source>
        <translation>Die Region auswählen, deren Maske zurückgesetzt werden soll.</translation>
    </message>
</context>
<context>
    <name>scantrove::ImagePage</name>
    <message>
        <source>There is no such picture of this frame.</source>
        <translation>Zu diesem Bild gibt es kein solches Teilbild.</translation>
    </message>
</context>
<context>
    <name>scantrove::ImagePanel</name>
    <message>
        <source>Click the title to enlarge the colour image again, twice for image mode</source>
        <translation>Ein Klick auf den Titel vergrößert wieder das Farbbild, zwei öffnen den Bildmodus</translation>
    </message>
    <message>
        <source>Click the title to enlarge, twice for image mode</source>
        <translation>Ein Klick auf den Titel vergrößert, zwei öffnen den Bildmodus</translation>
    </message>
</context>
<context>
    <name>scantrove::ImageViewBar</name>
    <message>
        <source>Names</source>
        <translation>Namen</translation>
    </message>
    <message>
        <source>3D view beside</source>
        <translation>3D-Ansicht daneben</translation>
    </message>
    <message>
        <source>Picture</source>
        <translation>Teilbild</translation>
    </message>
    <message>
        <source>The picture that is shown (V: next)</source>
        <translation>Das gezeigte Teilbild (V: nächstes)</translation>
    </message>
    <message>
        <source>M</source>
        <translation>M</translation>
    </message>
    <message>
        <source>Masks filled, as outlines, or not at all</source>
        <translation>Masken gefüllt, als Umrisse oder gar nicht</translation>
    </message>
    <message>
        <source>Shift+M</source>
        <translation>Shift+M</translation>
    </message>
    <message>
        <source>Names of regions</source>
        <translation>Namen der Regionen</translation>
    </message>
    <message>
        <source>Masks</source>
        <translation>Masken</translation>
    </message>
    <message>
        <source>Opacity of the masks</source>
        <translation>Deckkraft der Masken</translation>
    </message>
    <message>
        <source>Fused depth</source>
        <translation>Fusionierte Tiefe</translation>
    </message>
    <message>
        <source>Blend the depth of the map over the picture</source>
        <translation>Die Tiefe der Karte über das Bild blenden</translation>
    </message>
    <message>
        <source>D</source>
        <translation>D</translation>
    </message>
    <message>
        <source>3D view beside the image, from its camera</source>
        <translation>3D-Ansicht neben dem Bild, aus seiner Kamera</translation>
    </message>
    <message>
        <source>Masks: filled</source>
        <translation>Masken: gefüllt</translation>
    </message>
    <message>
        <source>Masks: outlines</source>
        <translation>Masken: Umrisse</translation>
    </message>
    <message>
        <source>Masks: off</source>
        <translation>Masken: aus</translation>
    </message>
</context>
<context>
    <name>scantrove::LanguageMenu</name>
    <message>
        <source>&amp;Language</source>
        <translation>Sp&amp;rache</translation>
    </message>
    <message>
        <source>The window has the chosen language when Scantrove is started again.</source>
        <translation>Das Fenster hat die gewählte Sprache, wenn Scantrove neu gestartet wird.</translation>
    </message>
    <message>
        <source>&amp;System</source>
        <translation>&amp;System</translation>
    </message>
    <message>
        <source>Follow the desktop, else English</source>
        <translation>Wie der Desktop, sonst Englisch</translation>
    </message>
</context>
<context>
    <name>scantrove::MainActions</name>
    <message>
        <source>Open &amp;folder…</source>
        <translation>&amp;Ordner öffnen…</translation>
    </message>
    <message>
        <source>Ctrl+O</source>
        <translation>Ctrl+O</translation>
    </message>
    <message>
        <source>Open a recording in a folder of images</source>
        <translation>Eine Aufnahme in einem Ordner mit Bildern öffnen</translation>
    </message>
    <message>
        <source>Open &amp;recording…</source>
        <translation>&amp;Aufnahme öffnen…</translation>
    </message>
    <message>
        <source>Ctrl+Shift+O</source>
        <translation>Ctrl+Shift+O</translation>
    </message>
    <message>
        <source>Open a recorded file (.oni, .bag, .db3, .mcap, .mkv, .r3d, .sens)</source>
        <translation>Eine aufgenommene Datei öffnen (.oni, .bag, .db3, .mcap, .mkv, .r3d, .sens)</translation>
    </message>
    <message>
        <source>Open &amp;with options…</source>
        <translation>&amp;Mit Optionen öffnen…</translation>
    </message>
    <message>
        <source>Ctrl+Alt+O</source>
        <translation>Ctrl+Alt+O</translation>
    </message>
    <message>
        <source>Set intrinsics, depth scale, or a part of the recording</source>
        <translation>Kameraparameter, Tiefenmaßstab oder einen Teil der Aufnahme angeben</translation>
    </message>
    <message>
        <source>&amp;Camera…</source>
        <translation>&amp;Kamera…</translation>
    </message>
    <message>
        <source>Ctrl+K</source>
        <translation>Ctrl+K</translation>
    </message>
    <message>
        <source>Scan with a depth camera</source>
        <translation>Mit einer Tiefenkamera scannen</translation>
    </message>
    <message>
        <source>&amp;Tabletop</source>
        <translation>&amp;Tisch</translation>
    </message>
    <message>
        <source>The built-in table with objects</source>
        <translation>Der eingebaute Tisch mit Objekten</translation>
    </message>
    <message>
        <source>&amp;Room</source>
        <translation>&amp;Raum</translation>
    </message>
    <message>
        <source>The built-in room</source>
        <translation>Der eingebaute Raum</translation>
    </message>
    <message>
        <source>Open pro&amp;ject…</source>
        <translation>&amp;Projekt öffnen…</translation>
    </message>
    <message>
        <source>Ctrl+J</source>
        <translation>Ctrl+J</translation>
    </message>
    <message>
        <source>Open another project: a folder with a catalogue and its scans</source>
        <translation>Ein anderes Projekt öffnen: einen Ordner mit einem Katalog und seinen Scans</translation>
    </message>
    <message>
        <source>&amp;New project…</source>
        <translation>&amp;Neues Projekt…</translation>
    </message>
    <message>
        <source>Ctrl+N</source>
        <translation>Ctrl+N</translation>
    </message>
    <message>
        <source>Make a project in a new folder</source>
        <translation>Ein Projekt in einem neuen Ordner anlegen</translation>
    </message>
    <message>
        <source>Open ca&amp;talogue…</source>
        <translation>Ka&amp;talog öffnen…</translation>
    </message>
    <message>
        <source>Open or create a catalogue outside projects</source>
        <translation>Einen Katalog außerhalb von Projekten öffnen oder anlegen</translation>
    </message>
    <message>
        <source>Connect to catalo&amp;gue…</source>
        <translation>Mit Katalog &amp;verbinden…</translation>
    </message>
    <message>
        <source>Use a catalogue on a PostgreSQL server, which several scanners share</source>
        <translation>Einen Katalog auf einem PostgreSQL-Server benutzen, den mehrere Scanner teilen</translation>
    </message>
    <message>
        <source>Open &amp;scan…</source>
        <translation>&amp;Scan öffnen…</translation>
    </message>
    <message>
        <source>Open a saved scan to label it</source>
        <translation>Einen gespeicherten Scan öffnen, um ihn zu beschriften</translation>
    </message>
    <message>
        <source>&amp;Export data set…</source>
        <translation>Datensatz e&amp;xportieren…</translation>
    </message>
    <message>
        <source>Ctrl+E</source>
        <translation>Ctrl+E</translation>
    </message>
    <message>
        <source>Export the labelled scan (COCO, BOP, meshes, …)</source>
        <translation>Den beschrifteten Scan exportieren (COCO, BOP, Netze, …)</translation>
    </message>
    <message>
        <source>C&amp;lose scan</source>
        <translation>Scan s&amp;chließen</translation>
    </message>
    <message>
        <source>Ctrl+W</source>
        <translation>Ctrl+W</translation>
    </message>
    <message>
        <source>Close this scan and show the start page; the scan stays saved</source>
        <translation>Diesen Scan schließen und die Startseite zeigen; der Scan bleibt gespeichert</translation>
    </message>
    <message>
        <source>&amp;Quit</source>
        <translation>&amp;Beenden</translation>
    </message>
    <message>
        <source>Ctrl+Q</source>
        <translation>Ctrl+Q</translation>
    </message>
    <message>
        <source>Quit Scantrove</source>
        <translation>Scantrove beenden</translation>
    </message>
    <message>
        <source>&amp;Start</source>
        <translation>&amp;Starten</translation>
    </message>
    <message>
        <source>Ctrl+R</source>
        <translation>Ctrl+R</translation>
    </message>
    <message>
        <source>Scan from the beginning, or resume</source>
        <translation>Von vorn scannen oder fortsetzen</translation>
    </message>
    <message>
        <source>&amp;Pause</source>
        <translation>&amp;Pause</translation>
    </message>
    <message>
        <source>Space</source>
        <translation>Space</translation>
    </message>
    <message>
        <source>Pause or resume</source>
        <translation>Anhalten oder fortsetzen</translation>
    </message>
    <message>
        <source>Step one &amp;frame</source>
        <translation>&amp;Ein Bild weiter</translation>
    </message>
    <message>
        <source>N</source>
        <translation>N</translation>
    </message>
    <message>
        <source>Process one frame, then pause</source>
        <translation>Ein Bild verarbeiten, dann anhalten</translation>
    </message>
    <message>
        <source>S&amp;top</source>
        <translation>S&amp;toppen</translation>
    </message>
    <message>
        <source>Ctrl+.</source>
        <translation>Ctrl+.</translation>
    </message>
    <message>
        <source>Stop the scan; its results are saved</source>
        <translation>Den Scan stoppen; seine Ergebnisse sind gespeichert</translation>
    </message>
    <message>
        <source>S&amp;kip refinement</source>
        <translation>Verfeinerung überspri&amp;ngen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+S</source>
        <translation>Ctrl+Shift+S</translation>
    </message>
    <message>
        <source>Refine later; the results so far are saved</source>
        <translation>Später verfeinern; die bisherigen Ergebnisse sind gespeichert</translation>
    </message>
    <message>
        <source>&amp;Refine objects</source>
        <translation>Objekte &amp;verfeinern</translation>
    </message>
    <message>
        <source>Ctrl+Shift+R</source>
        <translation>Ctrl+Shift+R</translation>
    </message>
    <message>
        <source>Refine the objects of this scan with its key frames</source>
        <translation>Die Objekte dieses Scans mit seinen Schlüsselbildern verfeinern</translation>
    </message>
    <message>
        <source>&amp;Continue scan…</source>
        <translation>Scan &amp;weiterführen…</translation>
    </message>
    <message>
        <source>Ctrl+Alt+R</source>
        <translation>Ctrl+Alt+R</translation>
    </message>
    <message>
        <source>Add frames of a recording or a camera to this saved scan</source>
        <translation>Bilder einer Aufnahme oder Kamera zu diesem gespeicherten Scan hinzufügen</translation>
    </message>
    <message>
        <source>Save p&amp;icture…</source>
        <translation>&amp;Bild speichern…</translation>
    </message>
    <message>
        <source>Ctrl+Shift+P</source>
        <translation>Ctrl+Shift+P</translation>
    </message>
    <message>
        <source>Draw the whole scan into a new PNG file</source>
        <translation>Den ganzen Scan in eine neue PNG-Datei zeichnen</translation>
    </message>
    <message>
        <source>Save turntable &amp;video…</source>
        <translation>Video einer &amp;Umrundung speichern…</translation>
    </message>
    <message>
        <source>Draw a video that goes around the scan once into a new WebM file</source>
        <translation>Ein Video, das einmal um den Scan herumgeht, in eine neue WebM-Datei zeichnen</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Rückgängig</translation>
    </message>
    <message>
        <source>Ctrl+Z</source>
        <translation>Ctrl+Z</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Wiederholen</translation>
    </message>
    <message>
        <source>Ctrl+Shift+Z</source>
        <translation>Ctrl+Shift+Z</translation>
    </message>
    <message>
        <source>Ctrl+Y</source>
        <translation>Ctrl+Y</translation>
    </message>
    <message>
        <source>Go to the object &amp;list</source>
        <translation>Zur &amp;Objektliste</translation>
    </message>
    <message>
        <source>Ctrl+L</source>
        <translation>Ctrl+L</translation>
    </message>
    <message>
        <source>Move the keyboard focus to the object list</source>
        <translation>Den Tastaturfokus auf die Objektliste setzen</translation>
    </message>
    <message>
        <source>&amp;Classes…</source>
        <translation>&amp;Klassen…</translation>
    </message>
    <message>
        <source>Ctrl+Shift+L</source>
        <translation>Ctrl+Shift+L</translation>
    </message>
    <message>
        <source>Rename, merge, colour, import and export the classes of the catalogue</source>
        <translation>Die Klassen des Katalogs umbenennen, zusammenführen, färben, importieren und exportieren</translation>
    </message>
    <message>
        <source>&amp;System</source>
        <translation>&amp;System</translation>
    </message>
    <message>
        <source>Follow the desktop</source>
        <translation>Wie der Desktop</translation>
    </message>
    <message>
        <source>&amp;Light</source>
        <translation>&amp;Hell</translation>
    </message>
    <message>
        <source>Use light colours</source>
        <translation>Helle Farben benutzen</translation>
    </message>
    <message>
        <source>&amp;Dark</source>
        <translation>&amp;Dunkel</translation>
    </message>
    <message>
        <source>Use dark colours</source>
        <translation>Dunkle Farben benutzen</translation>
    </message>
    <message>
        <source>&amp;Enlarge next image</source>
        <translation>Nächstes Bild v&amp;ergrößern</translation>
    </message>
    <message>
        <source>V</source>
        <translation>V</translation>
    </message>
    <message>
        <source>Show the next image of the frame large</source>
        <translation>Das nächste Teilbild groß zeigen</translation>
    </message>
    <message>
        <source>&amp;Previous key frame</source>
        <translation>&amp;Voriges Schlüsselbild</translation>
    </message>
    <message>
        <source>PgUp</source>
        <translation>PgUp</translation>
    </message>
    <message>
        <source>Go to the previous key frame</source>
        <translation>Zum vorigen Schlüsselbild gehen</translation>
    </message>
    <message>
        <source>Ne&amp;xt key frame</source>
        <translation>&amp;Nächstes Schlüsselbild</translation>
    </message>
    <message>
        <source>PgDown</source>
        <translation>PgDown</translation>
    </message>
    <message>
        <source>Go to the next key frame</source>
        <translation>Zum nächsten Schlüsselbild gehen</translation>
    </message>
    <message>
        <source>&amp;Presentation mode</source>
        <translation>&amp;Präsentation</translation>
    </message>
    <message>
        <source>F11</source>
        <translation>F11</translation>
    </message>
    <message>
        <source>Show the scene full screen; Escape ends</source>
        <translation>Die Szene im Vollbild zeigen; Escape beendet</translation>
    </message>
    <message>
        <source>&amp;Reset layout</source>
        <translation>Anordnung &amp;zurücksetzen</translation>
    </message>
    <message>
        <source>Move all panels back to their default positions</source>
        <translation>Alle Bereiche an ihre ursprünglichen Plätze zurücksetzen</translation>
    </message>
    <message>
        <source>&amp;Keys and mouse</source>
        <translation>&amp;Tasten und Maus</translation>
    </message>
    <message>
        <source>?</source>
        <translation>?</translation>
    </message>
    <message>
        <source>Show all keys and mouse actions</source>
        <translation>Alle Tasten und Mausaktionen zeigen</translation>
    </message>
    <message>
        <source>&amp;About Scantrove</source>
        <translation>Ü&amp;ber Scantrove</translation>
    </message>
    <message>
        <source>Show the version</source>
        <translation>Die Version zeigen</translation>
    </message>
    <message>
        <source>Res&amp;ume</source>
        <translation>&amp;Fortsetzen</translation>
    </message>
    <message>
        <source>&amp;Image mode</source>
        <translation>B&amp;ildmodus</translation>
    </message>
    <message>
        <source>Ctrl+I</source>
        <translation>Ctrl+I</translation>
    </message>
    <message>
        <source>Show an image in the main area, to look closer and to paint masks</source>
        <translation>Ein Bild im Hauptbereich zeigen, um genauer hinzusehen und Masken zu malen</translation>
    </message>
</context>
<context>
    <name>scantrove::MainMenus</name>
    <message>
        <source>&amp;File</source>
        <translation>&amp;Datei</translation>
    </message>
    <message>
        <source>&amp;Demo</source>
        <translation>&amp;Demo</translation>
    </message>
    <message>
        <source>Scan &amp;again</source>
        <translation>&amp;Erneut scannen</translation>
    </message>
    <message>
        <source>Recent &amp;projects</source>
        <translation>&amp;Zuletzt geöffnete Projekte</translation>
    </message>
    <message>
        <source>&amp;Edit</source>
        <translation>&amp;Bearbeiten</translation>
    </message>
    <message>
        <source>&amp;Scan</source>
        <translation>&amp;Scan</translation>
    </message>
    <message>
        <source>&amp;Objects</source>
        <translation>&amp;Objekte</translation>
    </message>
    <message>
        <source>&amp;Regions</source>
        <translation>&amp;Regionen</translation>
    </message>
    <message>
        <source>&amp;Recent names</source>
        <translation>Zuletzt benutzte &amp;Namen</translation>
    </message>
    <message>
        <source>Revie&amp;w</source>
        <translation>Prü&amp;fung</translation>
    </message>
    <message>
        <source>&amp;View</source>
        <translation>&amp;Ansicht</translation>
    </message>
    <message>
        <source>&amp;Theme</source>
        <translation>Farbsc&amp;hema</translation>
    </message>
    <message>
        <source>&amp;Help</source>
        <translation>&amp;Hilfe</translation>
    </message>
    <message>
        <source>Scan</source>
        <translation>Scan</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Öffnen</translation>
    </message>
    <message>
        <source>Open a recording, a camera or the demo</source>
        <translation>Eine Aufnahme, eine Kamera oder die Demo öffnen</translation>
    </message>
    <message>
        <source>Clear list</source>
        <translation>Liste leeren</translation>
    </message>
</context>
<context>
    <name>scantrove::MainWindow</name>
    <message>
        <source>History</source>
        <translation>Verlauf</translation>
    </message>
    <message>
        <source>Ctrl+4</source>
        <translation>Ctrl+4</translation>
    </message>
    <message>
        <source>Objects</source>
        <translation>Objekte</translation>
    </message>
    <message>
        <source>Ctrl+1</source>
        <translation>Ctrl+1</translation>
    </message>
    <message>
        <source>Settings</source>
        <translation>Einstellungen</translation>
    </message>
    <message>
        <source>Ctrl+3</source>
        <translation>Ctrl+3</translation>
    </message>
    <message>
        <source>Current frame</source>
        <translation>Aktuelles Bild</translation>
    </message>
    <message>
        <source>Ctrl+2</source>
        <translation>Ctrl+2</translation>
    </message>
</context>
<context>
    <name>scantrove::MeasureTool</name>
    <message>
        <source>%1 cm</source>
        <translation>%1 cm</translation>
    </message>
    <message>
        <source>%1 m</source>
        <translation>%1 m</translation>
    </message>
    <message>
        <source>Measure — click the other end; Escape ends</source>
        <translation>Messen — das andere Ende anklicken; Escape beendet</translation>
    </message>
    <message>
        <source>Measure — click one end; Escape ends</source>
        <translation>Messen — ein Ende anklicken; Escape beendet</translation>
    </message>
</context>
<context>
    <name>scantrove::MessageBar</name>
    <message>
        <source>Dismiss this message</source>
        <translation>Diese Meldung schließen</translation>
    </message>
    <message>
        <source>%1  (%2 times)</source>
        <translation>%1  (%2-mal)</translation>
    </message>
</context>
<context>
    <name>scantrove::ModelView</name>
    <message>
        <source>3D model</source>
        <translation>3D-Modell</translation>
    </message>
    <message>
        <source>The object as coloured points. Arrow keys turn, plus and minus zoom, Home shows all, Space starts and stops the turning.</source>
        <translation>Das Objekt als farbige Punkte. Pfeiltasten drehen, Plus und Minus zoomen, Pos1 zeigt alles, die Leertaste startet und beendet das Drehen.</translation>
    </message>
    <message>
        <source>Drag or arrow keys turn the model, the wheel zooms, Space starts and stops the turning.</source>
        <translation>Ziehen oder Pfeiltasten drehen das Modell, das Rad zoomt, die Leertaste startet und beendet das Drehen.</translation>
    </message>
    <message>
        <source>This display has no OpenGL 3.2.</source>
        <translation>Diese Anzeige hat kein OpenGL 3.2.</translation>
    </message>
</context>
<context>
    <name>scantrove::NameEditor</name>
    <message>
        <source>Name of the object</source>
        <translation>Name des Objekts</translation>
    </message>
</context>
<context>
    <name>scantrove::NextStepStrip</name>
    <message>
        <source>Next</source>
        <translation>Als Nächstes</translation>
    </message>
    <message>
        <source>Hide the next steps of this scan</source>
        <translation>Die nächsten Schritte dieses Scans ausblenden</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectAttributes</name>
    <message>
        <source>Its class has no attributes. “Classes” in the menu “Edit” adds some.</source>
        <translation>Seine Klasse hat keine Merkmale. „Klassen“ im Menü „Bearbeiten“ fügt welche hinzu.</translation>
    </message>
    <message>
        <source>not answered</source>
        <translation>nicht beantwortet</translation>
    </message>
    <message>
        <source>yes</source>
        <translation>ja</translation>
    </message>
    <message>
        <source>no</source>
        <translation>nein</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectDelegate</name>
    <message>
        <source>known</source>
        <translation>bekannt</translation>
    </message>
    <message>
        <source>new</source>
        <translation>neu</translation>
    </message>
    <message>
        <source>changed</source>
        <translation>geändert</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectFilterBar</name>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>Named</source>
        <translation>Benannt</translation>
    </message>
    <message>
        <source>Confirmed</source>
        <translation>Bestätigt</translation>
    </message>
    <message>
        <source>Not yet named</source>
        <translation>Noch unbenannt</translation>
    </message>
    <message>
        <source>In view</source>
        <translation>Im Bild</translation>
    </message>
    <message>
        <source>In this scan</source>
        <translation>In diesem Scan</translation>
    </message>
    <message>
        <source>&amp;Find object</source>
        <translation>Objekt &amp;suchen</translation>
    </message>
    <message>
        <source>Name or class</source>
        <translation>Name oder Klasse</translation>
    </message>
    <message>
        <source>Search objects</source>
        <translation>Objekte suchen</translation>
    </message>
    <message>
        <source>Clear the search</source>
        <translation>Suche leeren</translation>
    </message>
    <message>
        <source>Objects to show</source>
        <translation>Gezeigte Objekte</translation>
    </message>
    <message>
        <source>Which objects the list shows</source>
        <translation>Welche Objekte die Liste zeigt</translation>
    </message>
    <message>
        <source>Order of the objects</source>
        <translation>Reihenfolge der Objekte</translation>
    </message>
    <message>
        <source>Order of the list</source>
        <translation>Reihenfolge der Liste</translation>
    </message>
    <message>
        <source>Oldest first</source>
        <translation>Älteste zuerst</translation>
    </message>
    <message>
        <source>Newest first</source>
        <translation>Neueste zuerst</translation>
    </message>
    <message>
        <source>Name</source>
        <translation>Name</translation>
    </message>
    <message>
        <source>Class</source>
        <translation>Klasse</translation>
    </message>
    <message>
        <source>Most views</source>
        <translation>Meiste Ansichten</translation>
    </message>
    <message>
        <source>Largest</source>
        <translation>Größte</translation>
    </message>
    <message>
        <source>Find an object by its name or class (Ctrl+F)</source>
        <translation>Ein Objekt nach Name oder Klasse suchen (Strg+F)</translation>
    </message>
    <message>
        <source>%1 (%2)</source>
        <translation>%1 (%2)</translation>
    </message>
    <message>
        <source>No class</source>
        <translation>Ohne Klasse</translation>
    </message>
    <message>
        <source>Changed since confirmed</source>
        <translation>Seit Bestätigung geändert</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectHead</name>
    <message>
        <source>Confirmed</source>
        <translation>Bestätigt</translation>
    </message>
    <message>
        <source>Named, not confirmed</source>
        <translation>Benannt, nicht bestätigt</translation>
    </message>
    <message>
        <source>New, without a name</source>
        <translation>Neu, ohne Namen</translation>
    </message>
    <message>
        <source>Name of the object</source>
        <translation>Name des Objekts</translation>
    </message>
    <message>
        <source>The name, or class/name</source>
        <translation>Der Name oder Klasse/Name</translation>
    </message>
    <message>
        <source>No class</source>
        <translation>Ohne Klasse</translation>
    </message>
    <message>
        <source>Class: %1</source>
        <translation>Klasse: %1</translation>
    </message>
    <message>
        <source>Unconfirm</source>
        <translation>Bestätigung aufheben</translation>
    </message>
    <message>
        <source>Confirm</source>
        <translation>Bestätigen</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectListModel</name>
    <message>
        <source>%1 × %2 × %3 cm</source>
        <translation>%1 × %2 × %3 cm</translation>
    </message>
    <message numerus="yes">
        <source>%n views</source>
        <translation>
            <numerusform>%n Ansicht</numerusform>
            <numerusform>%n Ansichten</numerusform>
        </translation>
    </message>
    <message>
        <source>seen from all sides</source>
        <translation>von allen Seiten gesehen</translation>
    </message>
    <message>
        <source>seen from %1 of %2 sides</source>
        <translation>von %1 von %2 Seiten gesehen</translation>
    </message>
    <message>
        <source>%1, %2, %3, %4</source>
        <translation>%1, %2, %3, %4</translation>
    </message>
    <message>
        <source>no class</source>
        <translation>ohne Klasse</translation>
    </message>
    <message>
        <source>class %1</source>
        <translation>Klasse %1</translation>
    </message>
    <message>
        <source>confirmed</source>
        <translation>bestätigt</translation>
    </message>
    <message>
        <source>not confirmed</source>
        <translation>nicht bestätigt</translation>
    </message>
    <message>
        <source>Class: %1&lt;br&gt;</source>
        <translation>Klasse: %1&lt;br&gt;</translation>
    </message>
    <message>
        <source>&lt;b&gt;%1&lt;/b&gt;&lt;br&gt;%7%2, %3&lt;br&gt;%4First seen in: %5&lt;br&gt;%6</source>
        <translation>&lt;b&gt;%1&lt;/b&gt;&lt;br&gt;%7%2, %3&lt;br&gt;%4Zuerst gesehen in: %5&lt;br&gt;%6</translation>
    </message>
    <message>
        <source>In this scan %1&lt;br&gt;</source>
        <translation>In diesem Scan %1&lt;br&gt;</translation>
    </message>
    <message>
        <source>Confirmed</source>
        <translation>Bestätigt</translation>
    </message>
    <message>
        <source>Not confirmed: F2 renames, Return confirms</source>
        <translation>Nicht bestätigt: F2 benennt um, Return bestätigt</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectListView</name>
    <message>
        <source>Objects</source>
        <translation>Objekte</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectPage</name>
    <message>
        <source>Perhaps the same object</source>
        <translation>Vielleicht dasselbe Objekt</translation>
    </message>
    <message>
        <source>Seen in</source>
        <translation>Gesehen in</translation>
    </message>
    <message>
        <source>Attributes</source>
        <translation>Merkmale</translation>
    </message>
    <message>
        <source>Open a scan with it</source>
        <translation>Einen Scan damit öffnen</translation>
    </message>
    <message>
        <source>Views of the object</source>
        <translation>Ansichten des Objekts</translation>
    </message>
    <message>
        <source>Object: %1</source>
        <translation>Objekt: %1</translation>
    </message>
    <message>
        <source>View %1</source>
        <translation>Ansicht %1</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectPages</name>
    <message>
        <source>d MMM, HH:mm</source>
        <translation>d. MMM, HH:mm</translation>
    </message>
    <message numerus="yes">
        <source>%n key frames</source>
        <translation>
            <numerusform>%n Schlüsselbild</numerusform>
            <numerusform>%n Schlüsselbilder</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n regions</source>
        <translation>
            <numerusform>%n Region</numerusform>
            <numerusform>%n Regionen</numerusform>
        </translation>
    </message>
    <message>
        <source>In this scan %1</source>
        <translation>In diesem Scan %1</translation>
    </message>
    <message>
        <source>By the views of one scan %1</source>
        <translation>Nach den Ansichten eines Scans %1</translation>
    </message>
    <message>
        <source>From the open scan.</source>
        <translation>Aus dem offenen Scan.</translation>
    </message>
    <message numerus="yes">
        <source>From %n views, because no scan with it is open.</source>
        <translation>
            <numerusform>Aus %n Ansicht, weil kein Scan damit offen ist.</numerusform>
            <numerusform>Aus %n Ansichten, weil kein Scan damit offen ist.</numerusform>
        </translation>
    </message>
    <message>
        <source>No scan with it is open, and its views have no depth.</source>
        <translation>Kein Scan damit ist offen, und seine Ansichten haben keine Tiefe.</translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectPanel</name>
    <message>
        <source>No objects yet</source>
        <translation>Noch keine Objekte</translation>
    </message>
    <message>
        <source>Objects that a scan discovers appear here,
with their views, to name and confirm.</source>
        <translation>Objekte, die ein Scan entdeckt, erscheinen hier
mit ihren Ansichten, zum Benennen und Bestätigen.</translation>
    </message>
    <message>
        <source>No object matches</source>
        <translation>Kein Objekt passt</translation>
    </message>
    <message>
        <source>The search or the filter hides all objects.
Escape in the search field clears it.</source>
        <translation>Suche oder Filter verbergen alle Objekte.
Escape im Suchfeld leert es.</translation>
    </message>
    <message>
        <source>Go to the objects of this scan further down</source>
        <translation>Zu den Objekten dieses Scans weiter unten gehen</translation>
    </message>
    <message>
        <source>↓ %1 new</source>
        <translation>↓ %1 neu</translation>
    </message>
    <message>
        <source>&amp;Rename</source>
        <translation>&amp;Umbenennen</translation>
    </message>
    <message>
        <source>Give the object a name</source>
        <translation>Dem Objekt einen Namen geben</translation>
    </message>
    <message>
        <source>&amp;Confirm</source>
        <translation>&amp;Bestätigen</translation>
    </message>
    <message>
        <source>Confirm that this is an object and its name is right</source>
        <translation>Bestätigen, dass dies ein Objekt ist und der Name stimmt</translation>
    </message>
    <message>
        <source>&amp;Merge</source>
        <translation>&amp;Zusammenführen</translation>
    </message>
    <message>
        <source>Merge the selected objects into one</source>
        <translation>Die ausgewählten Objekte zu einem zusammenführen</translation>
    </message>
    <message>
        <source>&amp;Delete</source>
        <translation>&amp;Löschen</translation>
    </message>
    <message>
        <source>Delete the object from the catalogue (can be undone)</source>
        <translation>Das Objekt aus dem Katalog löschen (rückgängig machbar)</translation>
    </message>
    <message>
        <source>No catalogue</source>
        <translation>Kein Katalog</translation>
    </message>
    <message>
        <source>Catalogue: %1</source>
        <translation>Katalog: %1</translation>
    </message>
    <message>
        <source>%1 of %2 named, %3 confirmed</source>
        <translation>%1 von %2 benannt, %3 bestätigt</translation>
    </message>
    <message>
        <source>Un&amp;confirm</source>
        <translation>Nicht &amp;bestätigt</translation>
    </message>
    <message>
        <source>%1 selected</source>
        <translation>%1 ausgewählt</translation>
    </message>
    <message>
        <source>Select an object to see its views.</source>
        <translation>Ein Objekt auswählen, um seine Ansichten zu sehen.</translation>
    </message>
    <message>
        <source>Select one object to see its views.</source>
        <translation>Ein einzelnes Objekt auswählen, um seine Ansichten zu sehen.</translation>
    </message>
    <message>
        <source>This object has no views.</source>
        <translation>Dieses Objekt hat keine Ansichten.</translation>
    </message>
    <message>
        <source>Object &amp;page</source>
        <translation>Objektse&amp;ite</translation>
    </message>
    <message>
        <source>Show views, 3D model and scans of the object</source>
        <translation>Ansichten, 3D-Modell und Scans des Objekts zeigen</translation>
    </message>
</context>
<context>
    <name>scantrove::PaintController</name>
    <message>
        <source>There is no region under the first pixel. Select a region, or tick “New region”.</source>
        <translation>Unter dem ersten Pixel liegt keine Region. Eine Region auswählen oder „Neue Region“ anhaken.</translation>
    </message>
    <message>
        <source>The region has no hole there. Click into a hole that it encloses.</source>
        <translation>Die Region hat dort kein Loch. In ein Loch klicken, das sie umschließt.</translation>
    </message>
    <message>
        <source>The magic edge needs a colour image. Use the polygon here.</source>
        <translation>Die magische Kante braucht ein Farbbild. Hier das Polygon benutzen.</translation>
    </message>
    <message>
        <source>The selected region has none of these pixels.</source>
        <translation>Die ausgewählte Region hat keinen dieser Pixel.</translation>
    </message>
    <message>
        <source>There is no scanned surface to make a region of.</source>
        <translation>Hier gibt es keine gescannte Oberfläche für eine Region.</translation>
    </message>
</context>
<context>
    <name>scantrove::PaintToolBar</name>
    <message>
        <source>Smaller brush</source>
        <translation>Kleinerer Pinsel</translation>
    </message>
    <message>
        <source>Larger brush</source>
        <translation>Größerer Pinsel</translation>
    </message>
    <message>
        <source>New region</source>
        <translation>Neue Region</translation>
    </message>
    <message>
        <source>Reset mask</source>
        <translation>Maske zurücksetzen</translation>
    </message>
    <message>
        <source>This image only</source>
        <translation>Nur dieses Bild</translation>
    </message>
    <message>
        <source>Select</source>
        <translation>Auswählen</translation>
    </message>
    <message>
        <source>Select regions</source>
        <translation>Regionen auswählen</translation>
    </message>
    <message>
        <source>Brush</source>
        <translation>Pinsel</translation>
    </message>
    <message>
        <source>Paint: these pixels are the region</source>
        <translation>Malen: diese Pixel sind die Region</translation>
    </message>
    <message>
        <source>Eraser</source>
        <translation>Radierer</translation>
    </message>
    <message>
        <source>Erase: these pixels are not the region</source>
        <translation>Radieren: diese Pixel sind nicht die Region</translation>
    </message>
    <message>
        <source>Polygon</source>
        <translation>Polygon</translation>
    </message>
    <message>
        <source>Click the corners of an outline; Return or a double click closes it</source>
        <translation>Die Ecken eines Umrisses anklicken; Return oder ein Doppelklick schließt ihn</translation>
    </message>
    <message>
        <source>Magic edge</source>
        <translation>Magische Kante</translation>
    </message>
    <message>
        <source>Draw around a thing; the outline snaps to its edge</source>
        <translation>Um ein Ding herum zeichnen; der Umriss schnappt an seiner Kante ein</translation>
    </message>
    <message>
        <source>Fill hole</source>
        <translation>Loch füllen</translation>
    </message>
    <message>
        <source>Fill the hole under the pointer</source>
        <translation>Das Loch unter dem Zeiger füllen</translation>
    </message>
    <message>
        <source> px</source>
        <translation> px</translation>
    </message>
    <message>
        <source>Size of the brush ([ and ], or Ctrl + wheel)</source>
        <translation>Größe des Pinsels ([ und ], oder Strg + Mausrad)</translation>
    </message>
    <message>
        <source>Size of the brush</source>
        <translation>Größe des Pinsels</translation>
    </message>
    <message>
        <source>What is painted becomes a region of its own (Ins)</source>
        <translation>Das Gemalte wird eine eigene Region (Einfg)</translation>
    </message>
    <message>
        <source>Leave the regions behind and other images as they are</source>
        <translation>Die Regionen dahinter und andere Bilder so lassen, wie sie sind</translation>
    </message>
    <message>
        <source>Take back what was painted for the selected region in this image</source>
        <translation>Zurücknehmen, was für die ausgewählte Region in diesem Bild gemalt wurde</translation>
    </message>
</context>
<context>
    <name>scantrove::ParamsPanel</name>
    <message>
        <source>More settings</source>
        <translation>Weitere Einstellungen</translation>
    </message>
    <message>
        <source>Joining</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Minimum object size</source>
        <translation>Kleinstes Objekt</translation>
    </message>
    <message>
        <source>Maximum object size</source>
        <translation>Größtes Objekt</translation>
    </message>
    <message>
        <source>Found after</source>
        <translation>Gefunden nach</translation>
    </message>
    <message>
        <source>Recognition limit</source>
        <translation>Erkennungsgrenze</translation>
    </message>
    <message>
        <source>Voxel size *</source>
        <translation>Voxelgröße *</translation>
    </message>
    <message>
        <source>Farthest depth *</source>
        <translation>Größte Tiefe *</translation>
    </message>
    <message>
        <source>* applies to the next scan</source>
        <translation>* gilt ab dem nächsten Scan</translation>
    </message>
    <message>
        <source>Defaults</source>
        <translation>Vorgaben</translation>
    </message>
    <message>
        <source>Reset all parameters to their defaults</source>
        <translation>Alle Parameter auf ihre Vorgaben zurücksetzen</translation>
    </message>
    <message>
        <source>Segment size, k</source>
        <translation>Segmentgröße, k</translation>
    </message>
    <message>
        <source>A larger k gives fewer, larger segments. It takes effect at once, also on the frame that a paused or finished scan shows.</source>
        <translation>Ein größeres k gibt weniger und größere Segmente. Es wirkt sofort, auch auf das Bild, das ein angehaltener oder fertiger Scan zeigt.</translation>
    </message>
    <message>
        <source>finer</source>
        <translation>feiner</translation>
    </message>
    <message>
        <source>coarser</source>
        <translation>gröber</translation>
    </message>
    <message>
        <source>auto</source>
        <translation>auto</translation>
    </message>
</context>
<context>
    <name>scantrove::PictureSaver</name>
    <message>
        <source>Save picture</source>
        <translation>Bild speichern</translation>
    </message>
    <message>
        <source>Pictures (*.png)</source>
        <translation>Bilder (*.png)</translation>
    </message>
    <message>
        <source>Save turntable video</source>
        <translation>Video einer Umrundung speichern</translation>
    </message>
    <message>
        <source>Videos (*.webm)</source>
        <translation>Videos (*.webm)</translation>
    </message>
    <message>
        <source>Drawing %1…</source>
        <translation>%1 wird gezeichnet…</translation>
    </message>
    <message>
        <source>&amp;Cancel</source>
        <translation>&amp;Abbrechen</translation>
    </message>
    <message>
        <source>Saved %1.</source>
        <translation>%1 gespeichert.</translation>
    </message>
</context>
<context>
    <name>scantrove::Presentation</name>
    <message>
        <source>Object found: %1</source>
        <translation>Objekt gefunden: %1</translation>
    </message>
    <message>
        <source>Recognised: %1</source>
        <translation>Wiedererkannt: %1</translation>
    </message>
    <message>
        <source>Preparing the OpenCL device (once)</source>
        <translation>OpenCL-Gerät wird vorbereitet (einmalig)</translation>
    </message>
    <message>
        <source>Scantrove</source>
        <translation>Scantrove</translation>
    </message>
</context>
<context>
    <name>scantrove::ProgressStrip</name>
    <message>
        <source>Progress of the scan</source>
        <translation>Fortschritt des Scans</translation>
    </message>
    <message>
        <source>key frame %1 of %2</source>
        <translation>Schlüsselbild %1 von %2</translation>
    </message>
    <message numerus="yes">
        <source>%1 of %n frames</source>
        <translation>
            <numerusform>%1 von %n Bild</numerusform>
            <numerusform>%1 von %n Bildern</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1:%2   %n frames</source>
        <translation>
            <numerusform>%1:%2   %n Bild</numerusform>
            <numerusform>%1:%2   %n Bilder</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ProjectChoice</name>
    <message>
        <source>The last project %1 is missing. The window uses %2 now. Put it back and restart, or choose another with File &gt; Open project.</source>
        <translation>Das letzte Projekt %1 fehlt. Das Fenster benutzt jetzt %2. Das Projekt zurücklegen und neu starten, oder mit Datei &gt; Projekt öffnen ein anderes wählen.</translation>
    </message>
    <message>
        <source>This scan keeps its own catalogue. The next scan uses %1.</source>
        <translation>Dieser Scan behält seinen eigenen Katalog. Der nächste Scan benutzt %1.</translation>
    </message>
    <message>
        <source>The catalogue %1 of this scan is missing, so no objects are shown. Put the file back and open the scan again.</source>
        <translation>Der Katalog %1 dieses Scans fehlt, daher werden keine Objekte gezeigt. Die Datei zurücklegen und den Scan noch einmal öffnen.</translation>
    </message>
</context>
<context>
    <name>scantrove::ProposalBar</name>
    <message>
        <source>Is this a “%1” too? (%2)</source>
        <translation>Ist dies auch „%1“? (%2)</translation>
    </message>
    <message numerus="yes">
        <source>  and %n more</source>
        <translation>
            <numerusform>  und %n weiterer</numerusform>
            <numerusform>  und %n weitere</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::RegionActions</name>
    <message>
        <source>&amp;Name…</source>
        <translation>&amp;Benennen…</translation>
    </message>
    <message>
        <source>Name the region, which makes it an object of the catalogue</source>
        <translation>Die Region benennen; sie wird dadurch ein Objekt des Katalogs</translation>
    </message>
    <message>
        <source>&amp;Join</source>
        <translation>&amp;Verbinden</translation>
    </message>
    <message>
        <source>Join the selected regions into one</source>
        <translation>Die ausgewählten Regionen zu einer verbinden</translation>
    </message>
    <message>
        <source>&amp;Split…</source>
        <translation>&amp;Teilen…</translation>
    </message>
    <message>
        <source>Split a region along folds and colour edges, between two strokes or around one</source>
        <translation>Eine Region an Falten und Farbkanten teilen, zwischen zwei Strichen oder um einen herum</translation>
    </message>
    <message>
        <source>Split &amp;further</source>
        <translation>&amp;Weiter teilen</translation>
    </message>
    <message>
        <source>Split this region at its weakest borders</source>
        <translation>Diese Region an ihren schwächsten Grenzen teilen</translation>
    </message>
    <message>
        <source>&amp;Merge with neighbour</source>
        <translation>&amp;Mit Nachbar vereinen</translation>
    </message>
    <message>
        <source>Merge this region with its most likely neighbour</source>
        <translation>Diese Region mit ihrem wahrscheinlichsten Nachbarn vereinen</translation>
    </message>
    <message>
        <source>&amp;Background</source>
        <translation>&amp;Hintergrund</translation>
    </message>
    <message>
        <source>Mark as background (wall, floor, table), which data sets omit</source>
        <translation>Als Hintergrund (Wand, Boden, Tisch) markieren, den Datensätze weglassen</translation>
    </message>
    <message>
        <source>Mark as &amp;object</source>
        <translation>Als &amp;Objekt markieren</translation>
    </message>
    <message>
        <source>Add the region to the catalogue</source>
        <translation>Die Region in den Katalog aufnehmen</translation>
    </message>
    <message>
        <source>No&amp;t an object</source>
        <translation>&amp;Kein Objekt</translation>
    </message>
    <message>
        <source>Mark as not an object; it is not suggested again</source>
        <translation>Als kein Objekt markieren; sie wird nicht wieder vorgeschlagen</translation>
    </message>
    <message>
        <source>&amp;Accept suggestion</source>
        <translation>Vorschlag &amp;annehmen</translation>
    </message>
    <message>
        <source>Accept this suggestion</source>
        <translation>Diesen Vorschlag annehmen</translation>
    </message>
    <message>
        <source>Accept &amp;all suggestions</source>
        <translation>A&amp;lle Vorschläge annehmen</translation>
    </message>
    <message>
        <source>Accept all suggestions</source>
        <translation>Alle Vorschläge annehmen</translation>
    </message>
    <message>
        <source>Re&amp;ject suggestion</source>
        <translation>Vorschlag abl&amp;ehnen</translation>
    </message>
    <message>
        <source>Reject this suggestion permanently</source>
        <translation>Diesen Vorschlag endgültig ablehnen</translation>
    </message>
    <message>
        <source>Mark s&amp;upports as background</source>
        <translation>Au&amp;flagen als Hintergrund markieren</translation>
    </message>
    <message>
        <source>Mark all surfaces that things stand on as background</source>
        <translation>Alle Flächen, auf denen Dinge stehen, als Hintergrund markieren</translation>
    </message>
    <message>
        <source>Ne&amp;xt region</source>
        <translation>Nä&amp;chste Region</translation>
    </message>
    <message>
        <source>Select the next smaller region</source>
        <translation>Die nächstkleinere Region auswählen</translation>
    </message>
    <message>
        <source>Pre&amp;vious region</source>
        <translation>Vo&amp;rige Region</translation>
    </message>
    <message>
        <source>Select the next larger region</source>
        <translation>Die nächstgrößere Region auswählen</translation>
    </message>
    <message>
        <source>&amp;Zoom to selection</source>
        <translation>Auf Auswahl &amp;zoomen</translation>
    </message>
    <message>
        <source>Show the selected region in the 3D view</source>
        <translation>Die ausgewählte Region in der 3D-Ansicht zeigen</translation>
    </message>
    <message>
        <source>&amp;Deselect</source>
        <translation>A&amp;uswahl aufheben</translation>
    </message>
    <message>
        <source>Clear the selection</source>
        <translation>Die Auswahl aufheben</translation>
    </message>
    <message>
        <source>Give this name</source>
        <translation>Diesen Namen geben</translation>
    </message>
</context>
<context>
    <name>scantrove::RegionController</name>
    <message>
        <source>Point at a region to name, or click it.</source>
        <translation>Auf die Region zeigen, die benannt wird, oder sie anklicken.</translation>
    </message>
    <message>
        <source>&amp;Recent names</source>
        <translation>Zuletzt benutzte &amp;Namen</translation>
    </message>
    <message>
        <source>%1 × %2 × %3 cm</source>
        <translation>%1 × %2 × %3 cm</translation>
    </message>
    <message>
        <source>class %1</source>
        <translation>Klasse %1</translation>
    </message>
    <message>
        <source>%1 voxels</source>
        <translation>%1 Voxel</translation>
    </message>
    <message>
        <source>background</source>
        <translation>Hintergrund</translation>
    </message>
    <message>
        <source>rejected</source>
        <translation>verworfen</translation>
    </message>
    <message>
        <source>object</source>
        <translation>Objekt</translation>
    </message>
    <message>
        <source>object %1</source>
        <translation>Objekt %1</translation>
    </message>
    <message>
        <source>looks like background: things stand on it</source>
        <translation>sieht nach Hintergrund aus: Dinge stehen darauf</translation>
    </message>
</context>
<context>
    <name>scantrove::RegionNameEditor</name>
    <message>
        <source>Name, class, or class/name</source>
        <translation>Name, Klasse oder Klasse/Name</translation>
    </message>
    <message>
        <source>Name of the region</source>
        <translation>Name der Region</translation>
    </message>
</context>
<context>
    <name>scantrove::RegionNaming</name>
    <message numerus="yes">
        <source>Name of %n regions</source>
        <translation>
            <numerusform>Name von %n Region</numerusform>
            <numerusform>Name von %n Regionen</numerusform>
        </translation>
    </message>
    <message>
        <source>Name of %1</source>
        <translation>Name von %1</translation>
    </message>
</context>
<context>
    <name>scantrove::RegionOperations</name>
    <message>
        <source>%1 is background, which data sets omit. Make it an object with the name “%2”?</source>
        <translation>%1 ist Hintergrund, den Datensätze weglassen. Zu einem Objekt mit dem Namen „%2“ machen?</translation>
    </message>
    <message>
        <source>Make it an object</source>
        <translation>Zum Objekt machen</translation>
    </message>
    <message>
        <source>Select the regions to join: click one, then Ctrl+click the others.</source>
        <translation>Die Regionen auswählen, die verbunden werden: eine anklicken, die anderen mit Strg+Klick.</translation>
    </message>
    <message>
        <source>%1 is background. Join what is selected with it?</source>
        <translation>%1 ist Hintergrund. Die Auswahl damit verbinden?</translation>
    </message>
    <message>
        <source>Join</source>
        <translation>Verbinden</translation>
    </message>
    <message>
        <source>Background</source>
        <translation>Hintergrund</translation>
    </message>
    <message numerus="yes">
        <source>%n regions</source>
        <translation>
            <numerusform>%n Region</numerusform>
            <numerusform>%n Regionen</numerusform>
        </translation>
    </message>
    <message>
        <source>Remove the name of %1</source>
        <translation>Namen von %1 entfernen</translation>
    </message>
    <message>
        <source>Name %1 “%2”</source>
        <translation>%1 „%2“ nennen</translation>
    </message>
    <message>
        <source>Join %1</source>
        <translation>%1 verbinden</translation>
    </message>
    <message>
        <source>Split %1</source>
        <translation>%1 teilen</translation>
    </message>
    <message>
        <source>Split %1 further</source>
        <translation>%1 weiter teilen</translation>
    </message>
    <message>
        <source>Merge %1 with its neighbour</source>
        <translation>%1 mit dem Nachbarn vereinen</translation>
    </message>
    <message>
        <source>%1: background</source>
        <translation>%1: Hintergrund</translation>
    </message>
    <message>
        <source>%1: not background</source>
        <translation>%1: kein Hintergrund</translation>
    </message>
    <message>
        <source>%1: an object</source>
        <translation>%1: ein Objekt</translation>
    </message>
    <message>
        <source>%1: not an object</source>
        <translation>%1: kein Objekt</translation>
    </message>
    <message>
        <source>%1: not rejected</source>
        <translation>%1: nicht verworfen</translation>
    </message>
    <message>
        <source>Correct mask of %1 in image %2</source>
        <translation>Maske von %1 in Bild %2 berichtigen</translation>
    </message>
    <message>
        <source>Image %1: open</source>
        <translation>Bild %1: offen</translation>
    </message>
    <message>
        <source>Image %1: checked</source>
        <translation>Bild %1: geprüft</translation>
    </message>
    <message>
        <source>Image %1: left out</source>
        <translation>Bild %1: ausgelassen</translation>
    </message>
    <message>
        <source>Paint a new region in image %1</source>
        <translation>Neue Region in Bild %1 malen</translation>
    </message>
    <message>
        <source>Correct mask of %1</source>
        <translation>Maske von %1 berichtigen</translation>
    </message>
    <message>
        <source>Reset mask of %1</source>
        <translation>Maske von %1 zurücksetzen</translation>
    </message>
    <message>
        <source>Reset mask of %1 in image %2</source>
        <translation>Maske von %1 in Bild %2 zurücksetzen</translation>
    </message>
</context>
<context>
    <name>scantrove::RegionProposals</name>
    <message>
        <source>%1 %, %2 × %3 × %4 cm</source>
        <translation>%1 %, %2 × %3 × %4 cm</translation>
    </message>
</context>
<context>
    <name>scantrove::RegionSelection</name>
    <message>
        <source>Region %1</source>
        <translation>Region %1</translation>
    </message>
</context>
<context>
    <name>scantrove::RegionSplitter</name>
    <message>
        <source>These are two regions already: %1 and %2. Draw on one region.</source>
        <translation>Dies sind schon zwei Regionen: %1 und %2. Auf einer Region zeichnen.</translation>
    </message>
    <message>
        <source>There is no depth at that point. Draw on a highlighted region.</source>
        <translation>An dieser Stelle gibt es keine Tiefe. Auf einer hervorgehobenen Region zeichnen.</translation>
    </message>
    <message>
        <source>Split, 1 of 2: draw over one part, or click it. Shift adds strokes, Escape cancels</source>
        <translation>Teilen, 1 von 2: über einen Teil zeichnen oder ihn anklicken. Umschalt fügt Striche hinzu, Escape bricht ab</translation>
    </message>
    <message>
        <source>Split, 2 of 2: draw over the other part, or click it. Return splits by colour, Escape cancels</source>
        <translation>Teilen, 2 von 2: über den anderen Teil zeichnen oder ihn anklicken. Return teilt nach Farbe, Escape bricht ab</translation>
    </message>
    <message>
        <source>Split. Return accepts, Escape undoes</source>
        <translation>Geteilt. Return nimmt an, Escape macht rückgängig</translation>
    </message>
    <message>
        <source>Draw over one part</source>
        <translation>Über einen Teil zeichnen</translation>
    </message>
    <message>
        <source>Draw over the other part</source>
        <translation>Über den anderen Teil zeichnen</translation>
    </message>
</context>
<context>
    <name>scantrove::ReviewController</name>
    <message>
        <source>Mark image as chec&amp;ked</source>
        <translation>Bild als &amp;geprüft markieren</translation>
    </message>
    <message>
        <source>K</source>
        <translation>K</translation>
    </message>
    <message>
        <source>The labels of this key frame are right; go to the next open one</source>
        <translation>Die Labels dieses Schlüsselbildes stimmen; weiter zum nächsten offenen</translation>
    </message>
    <message>
        <source>&amp;Leave image out</source>
        <translation>Bild &amp;auslassen</translation>
    </message>
    <message>
        <source>Shift+K</source>
        <translation>Shift+K</translation>
    </message>
    <message>
        <source>No data set has this key frame; go to the next open one</source>
        <translation>Kein Datensatz enthält dieses Schlüsselbild; weiter zum nächsten offenen</translation>
    </message>
    <message>
        <source>Mark image as &amp;open</source>
        <translation>Bild als &amp;offen markieren</translation>
    </message>
    <message>
        <source>Ctrl+Shift+K</source>
        <translation>Ctrl+Shift+K</translation>
    </message>
    <message>
        <source>This key frame is to be checked</source>
        <translation>Dieses Schlüsselbild ist noch zu prüfen</translation>
    </message>
    <message>
        <source>Next open key frame</source>
        <translation>Nächstes offenes Schlüsselbild</translation>
    </message>
    <message>
        <source>Ctrl+PgDown</source>
        <translation>Ctrl+PgDown</translation>
    </message>
    <message>
        <source>Go to the next key frame that is not checked</source>
        <translation>Zum nächsten ungeprüften Schlüsselbild gehen</translation>
    </message>
    <message>
        <source>Previous open key frame</source>
        <translation>Voriges offenes Schlüsselbild</translation>
    </message>
    <message>
        <source>Ctrl+PgUp</source>
        <translation>Ctrl+PgUp</translation>
    </message>
    <message>
        <source>Go to the previous key frame that is not checked</source>
        <translation>Zum vorigen ungeprüften Schlüsselbild gehen</translation>
    </message>
</context>
<context>
    <name>scantrove::ReviewMarks</name>
    <message>
        <source>open</source>
        <translation>offen</translation>
    </message>
    <message>
        <source>checked</source>
        <translation>geprüft</translation>
    </message>
    <message>
        <source>left out</source>
        <translation>ausgelassen</translation>
    </message>
    <message>
        <source>Review states of the key frames</source>
        <translation>Prüfstand der Schlüsselbilder</translation>
    </message>
    <message>
        <source>Frame %1: %2</source>
        <translation>Bild %1: %2</translation>
    </message>
</context>
<context>
    <name>scantrove::SameNameChoice</name>
    <message>
        <source>Another thing of this class (Return)</source>
        <translation>Ein anderes Ding dieser Klasse (Return)</translation>
    </message>
    <message>
        <source>The same object: the two become one (Shift+Return)</source>
        <translation>Dasselbe Objekt: die beiden werden eines (Umschalt+Return)</translation>
    </message>
    <message>
        <source>%1 (Return)</source>
        <translation>%1 (Return)</translation>
    </message>
    <message>
        <source>%1 (Shift+Return)</source>
        <translation>%1 (Umschalt+Return)</translation>
    </message>
</context>
<context>
    <name>scantrove::SavedScansPanel</name>
    <message>
        <source>damaged</source>
        <translation>beschädigt</translation>
    </message>
    <message>
        <source>d MMM, HH:mm</source>
        <translation>d. MMM, HH:mm</translation>
    </message>
    <message>
        <source>in use</source>
        <translation>in Benutzung</translation>
    </message>
    <message>
        <source>recovered</source>
        <translation>wiederhergestellt</translation>
    </message>
    <message numerus="yes">
        <source>%1 of %n objects named</source>
        <translation>
            <numerusform>%1 von %n Objekt benannt</numerusform>
            <numerusform>%1 von %n Objekten benannt</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n frames</source>
        <translation>
            <numerusform>%n Bild</numerusform>
            <numerusform>%n Bilder</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 of %n images reviewed</source>
        <translation>
            <numerusform>%1 von %n Bild durchgesehen</numerusform>
            <numerusform>%1 von %n Bildern durchgesehen</numerusform>
        </translation>
    </message>
    <message>
        <source>%1 MB</source>
        <translation>%1 MB</translation>
    </message>
    <message>
        <source>Delete the scan %1</source>
        <translation>Scan %1 löschen</translation>
    </message>
    <message>
        <source>The scan %1 is in use and was not deleted. Close it first.</source>
        <translation>Der Scan %1 ist in Benutzung und wurde nicht gelöscht. Zuerst schließen.</translation>
    </message>
    <message>
        <source>The scan %1 cannot be moved to the trash. It was not changed.</source>
        <translation>Der Scan %1 kann nicht in den Papierkorb verschoben werden. Er wurde nicht geändert.</translation>
    </message>
    <message>
        <source>The scan cannot be restored from the trash. It is in %1.</source>
        <translation>Der Scan kann nicht aus dem Papierkorb zurückgeholt werden. Er liegt in %1.</translation>
    </message>
    <message>
        <source>Saved scans</source>
        <translation>Gespeicherte Scans</translation>
    </message>
    <message numerus="yes">
        <source>and %n more: File &gt; Open scan</source>
        <translation>
            <numerusform>und %n weiterer: Datei &gt; Scan öffnen</numerusform>
            <numerusform>und %n weitere: Datei &gt; Scan öffnen</numerusform>
        </translation>
    </message>
    <message>
        <source>&amp;Delete (can be undone)</source>
        <translation>&amp;Löschen (rückgängig machbar)</translation>
    </message>
    <message>
        <source>Continue, refine, export or delete this scan</source>
        <translation>Diesen Scan weiterführen, verfeinern, exportieren oder löschen</translation>
    </message>
    <message>
        <source>Actions of %1</source>
        <translation>Aktionen für %1</translation>
    </message>
    <message>
        <source>&amp;Open</source>
        <translation>Ö&amp;ffnen</translation>
    </message>
    <message>
        <source>Label and review this scan</source>
        <translation>Diesen Scan beschriften und durchsehen</translation>
    </message>
    <message>
        <source>&amp;Continue scan…</source>
        <translation>Scan &amp;weiterführen…</translation>
    </message>
    <message>
        <source>Add frames: the camera finds its place in the map again</source>
        <translation>Bilder hinzufügen: die Kamera findet ihren Platz in der Karte wieder</translation>
    </message>
    <message>
        <source>&amp;Refine objects</source>
        <translation>Objekte &amp;verfeinern</translation>
    </message>
    <message>
        <source>Do the refinement that this scan did not get</source>
        <translation>Die Verfeinerung nachholen, die diesem Scan fehlt</translation>
    </message>
    <message>
        <source>&amp;Export data set…</source>
        <translation>Datensatz e&amp;xportieren…</translation>
    </message>
    <message>
        <source>Open this scan and export it</source>
        <translation>Diesen Scan öffnen und exportieren</translation>
    </message>
</context>
<context>
    <name>scantrove::ScanController</name>
    <message>
        <source>The scan is not saved, because %1 is not writable. Make it writable, or open another project.</source>
        <translation>Der Scan wird nicht gespeichert, weil %1 nicht beschreibbar ist. Schreibrechte geben oder ein anderes Projekt öffnen.</translation>
    </message>
</context>
<context>
    <name>scantrove::ScanDisplay</name>
    <message>
        <source>Use %1 units per metre</source>
        <translation>%1 Einheiten je Meter verwenden</translation>
    </message>
</context>
<context>
    <name>scantrove::ScanLinks</name>
    <message>
        <source>Scans with the object</source>
        <translation>Scans mit dem Objekt</translation>
    </message>
    <message>
        <source>No saved scan of this project has it.</source>
        <translation>Kein gespeicherter Scan dieses Projekts hat es.</translation>
    </message>
    <message>
        <source>This scan is open</source>
        <translation>Dieser Scan ist offen</translation>
    </message>
    <message>
        <source>Open %1</source>
        <translation>%1 öffnen</translation>
    </message>
</context>
<context>
    <name>scantrove::SceneDrawing</name>
    <message>
        <source>The 3D view needs OpenGL 3.2, which this display does not offer.
Everything else works. Mesa&apos;s llvmpipe provides it on any computer.</source>
        <translation>Die 3D-Ansicht braucht OpenGL 3.2, das diese Anzeige nicht bietet.
Alles andere geht. Mesas llvmpipe stellt es auf jedem Rechner bereit.</translation>
    </message>
</context>
<context>
    <name>scantrove::SceneNames</name>
    <message>
        <source>&amp;Names</source>
        <translation>&amp;Namen</translation>
    </message>
    <message>
        <source>Shift+N</source>
        <translation>Shift+N</translation>
    </message>
    <message>
        <source>Show the names of the regions in the 3D view (%1)</source>
        <translation>Die Namen der Regionen in der 3D-Ansicht zeigen (%1)</translation>
    </message>
</context>
<context>
    <name>scantrove::ScenePane</name>
    <message>
        <source>&amp;Follow the camera</source>
        <translation>Der &amp;Kamera folgen</translation>
    </message>
    <message>
        <source>Show &amp;all</source>
        <translation>&amp;Alles zeigen</translation>
    </message>
    <message>
        <source>Ground &amp;grid</source>
        <translation>&amp;Bodengitter</translation>
    </message>
    <message>
        <source>Follow the camera (F)</source>
        <translation>Der Kamera folgen (F)</translation>
    </message>
    <message>
        <source>Ctrl+0</source>
        <translation>Ctrl+0</translation>
    </message>
    <message>
        <source>Show all (Home or double click in the view)</source>
        <translation>Alles zeigen (Pos1 oder Doppelklick in der Ansicht)</translation>
    </message>
    <message>
        <source>Ground grid, half-metre squares (G)</source>
        <translation>Bodengitter, Felder von einem halben Meter (G)</translation>
    </message>
</context>
<context>
    <name>scantrove::SceneView</name>
    <message>
        <source>3D view</source>
        <translation>3D-Ansicht</translation>
    </message>
    <message>
        <source>The scanned scene as coloured points. Arrow keys turn, plus and minus zoom, Home shows all.</source>
        <translation>Die gescannte Szene als farbige Punkte. Pfeiltasten drehen, Plus und Minus zoomen, Pos1 zeigt alles.</translation>
    </message>
</context>
<context>
    <name>scantrove::ServerDialog</name>
    <message>
        <source>&amp;Test</source>
        <translation>&amp;Testen</translation>
    </message>
    <message>
        <source>&amp;Connect</source>
        <translation>&amp;Verbinden</translation>
    </message>
    <message>
        <source>Connect to catalogue</source>
        <translation>Mit Katalog verbinden</translation>
    </message>
    <message>
        <source>Several scanners can share a catalogue on a PostgreSQL server. The password does not belong here: put it into ~/.pgpass.</source>
        <translation>Mehrere Scanner können sich einen Katalog auf einem PostgreSQL-Server teilen. Das Passwort gehört nicht hierher, sondern in ~/.pgpass.</translation>
    </message>
    <message>
        <source>&amp;Address</source>
        <translation>&amp;Adresse</translation>
    </message>
    <message>
        <source>The server answers. A new catalogue is created in this database.</source>
        <translation>Der Server antwortet. In dieser Datenbank wird ein neuer Katalog angelegt.</translation>
    </message>
    <message numerus="yes">
        <source>The server answers. The catalogue holds %n objects.</source>
        <translation>
            <numerusform>Der Server antwortet. Der Katalog enthält %n Objekt.</numerusform>
            <numerusform>Der Server antwortet. Der Katalog enthält %n Objekte.</numerusform>
        </translation>
    </message>
    <message>
        <source>Connecting…</source>
        <translation>Verbindung wird aufgebaut…</translation>
    </message>
</context>
<context>
    <name>scantrove::ShapeWatch</name>
    <message>
        <source>%1 times as large as when you confirmed it: %2, then %3</source>
        <translation>%1-mal so groß wie bei der Bestätigung: %2, damals %3</translation>
    </message>
    <message>
        <source>Only %1 % as large as when you confirmed it: %2, then %3</source>
        <translation>Nur %1 % so groß wie bei der Bestätigung: %2, damals %3</translation>
    </message>
    <message>
        <source>Most of it has other colours than when you confirmed it</source>
        <translation>Das meiste daran hat andere Farben als bei der Bestätigung</translation>
    </message>
</context>
<context>
    <name>scantrove::SourceDialog</name>
    <message>
        <source>all</source>
        <translation>alle</translation>
    </message>
    <message>
        <source>Scan &amp;one object</source>
        <translation>Nur &amp;ein Objekt scannen</translation>
    </message>
    <message>
        <source>Scan what stands near the middle of the first image alone, on a turntable or in a hand. The surface below it and the room are left out.</source>
        <translation>Nur das scannen, was nahe der Mitte des ersten Bildes steht, auf einem Drehteller oder in der Hand. Die Fläche darunter und der Raum bleiben weg.</translation>
    </message>
    <message>
        <source>Open with options</source>
        <translation>Mit Optionen öffnen</translation>
    </message>
    <message>
        <source>from the recording; or fx, fy, cx, cy in pixels</source>
        <translation>aus der Aufnahme; oder fx, fy, cx, cy in Pixeln</translation>
    </message>
    <message>
        <source>from the recording; or units per metre</source>
        <translation>aus der Aufnahme; oder Einheiten je Meter</translation>
    </message>
    <message>
        <source>Automatic</source>
        <translation>Automatisch</translation>
    </message>
    <message>
        <source>Poses of a device that tracks itself help to track the camera; others are not used.</source>
        <translation>Posen eines Geräts, das sich selbst verfolgt, helfen beim Verfolgen der Kamera; andere werden nicht benutzt.</translation>
    </message>
    <message>
        <source>Track the camera</source>
        <translation>Kamera verfolgen</translation>
    </message>
    <message>
        <source>Poses of the recording are not used.</source>
        <translation>Posen der Aufnahme werden nicht benutzt.</translation>
    </message>
    <message>
        <source>Use the poses of the recording</source>
        <translation>Posen der Aufnahme benutzen</translation>
    </message>
    <message>
        <source>The camera is not tracked.</source>
        <translation>Die Kamera wird nicht verfolgt.</translation>
    </message>
    <message>
        <source>Browse…</source>
        <translation>Durchsuchen…</translation>
    </message>
    <message>
        <source>Folder or recording</source>
        <translation>Ordner oder Aufnahme</translation>
    </message>
    <message>
        <source>&amp;Intrinsics</source>
        <translation>&amp;Kameraparameter</translation>
    </message>
    <message>
        <source>&amp;Depth scale</source>
        <translation>&amp;Tiefenmaßstab</translation>
    </message>
    <message>
        <source>Camera &amp;poses</source>
        <translation>Kamera&amp;posen</translation>
    </message>
    <message>
        <source>&amp;Skip first frames</source>
        <translation>Erste Bilder über&amp;springen</translation>
    </message>
    <message>
        <source>&amp;Every n-th frame</source>
        <translation>&amp;Jedes n-te Bild</translation>
    </message>
    <message>
        <source>At &amp;most frames</source>
        <translation>&amp;Höchstens so viele Bilder</translation>
    </message>
    <message>
        <source>Continue scan %1</source>
        <translation>Scan %1 weiterführen</translation>
    </message>
    <message>
        <source>a recording of the same place, or camera</source>
        <translation>eine Aufnahme desselben Ortes, oder camera</translation>
    </message>
    <message>
        <source>&amp;Continue scan</source>
        <translation>Scan &amp;weiterführen</translation>
    </message>
    <message>
        <source>Folder of the recording</source>
        <translation>Ordner der Aufnahme</translation>
    </message>
</context>
<context>
    <name>scantrove::StartPage</name>
    <message>
        <source>Demo: tabletop</source>
        <translation>Demo: Tisch</translation>
    </message>
    <message>
        <source>Demo: room</source>
        <translation>Demo: Raum</translation>
    </message>
    <message>
        <source>Camera</source>
        <translation>Kamera</translation>
    </message>
    <message>
        <source>Virtual test camera</source>
        <translation>Virtuelle Testkamera</translation>
    </message>
    <message>
        <source>Camera %1</source>
        <translation>Kamera %1</translation>
    </message>
    <message>
        <source>Kinect</source>
        <translation>Kinect</translation>
    </message>
    <message>
        <source>Kinect %1</source>
        <translation>Kinect %1</translation>
    </message>
    <message>
        <source>RealSense</source>
        <translation>RealSense</translation>
    </message>
    <message>
        <source>RealSense %1</source>
        <translation>RealSense %1</translation>
    </message>
    <message>
        <source>iPhone with Record3D</source>
        <translation>iPhone mit Record3D</translation>
    </message>
    <message>
        <source>iPhone %1</source>
        <translation>iPhone %1</translation>
    </message>
    <message>
        <source>Sweep a depth camera over a scene. Scantrove discovers its objects, recognises known ones, and collects the others for you to name and confirm.</source>
        <translation>Mit einer Tiefenkamera über eine Szene fahren: Scantrove entdeckt ihre Objekte, erkennt bekannte wieder und sammelt die anderen zum Benennen und Bestätigen.</translation>
    </message>
    <message>
        <source>Open folder…</source>
        <translation>Ordner öffnen…</translation>
    </message>
    <message>
        <source>Phones, 7-Scenes, TUM, ScanNet, NYUv2, any images</source>
        <translation>Telefone, 7-Scenes, TUM, ScanNet, NYUv2, beliebige Bilder</translation>
    </message>
    <message>
        <source>Open recording…</source>
        <translation>Aufnahme öffnen…</translation>
    </message>
    <message>
        <source>RealSense, Azure Kinect, ROS, Record3D, OpenNI</source>
        <translation>RealSense, Azure Kinect, ROS, Record3D, OpenNI</translation>
    </message>
    <message>
        <source>Camera…</source>
        <translation>Kamera…</translation>
    </message>
    <message>
        <source>A depth camera on this computer</source>
        <translation>Eine Tiefenkamera an diesem Rechner</translation>
    </message>
    <message>
        <source>A built-in scene; no camera needed</source>
        <translation>Eine eingebaute Szene, ohne Kamera</translation>
    </message>
    <message>
        <source>Scan again</source>
        <translation>Erneut scannen</translation>
    </message>
    <message>
        <source>Or drop a folder or a recording on this window. Press ? for all keys.</source>
        <translation>Oder einen Ordner oder eine Aufnahme auf dieses Fenster ziehen. ? zeigt alle Tasten.</translation>
    </message>
    <message>
        <source>Open project…</source>
        <translation>Projekt öffnen…</translation>
    </message>
    <message>
        <source>New project…</source>
        <translation>Neues Projekt…</translation>
    </message>
    <message>
        <source>Project: %1</source>
        <translation>Projekt: %1</translation>
    </message>
    <message>
        <source>Catalogue and scans of this project: %1</source>
        <translation>Katalog und Scans dieses Projekts: %1</translation>
    </message>
</context>
<context>
    <name>scantrove::StatusStrip</name>
    <message>
        <source>Tracking</source>
        <translation>Verfolgung läuft</translation>
    </message>
    <message>
        <source>Uncertain</source>
        <translation>Unsicher</translation>
    </message>
    <message>
        <source>Lost: point the camera at a place that it has seen</source>
        <translation>Verloren: die Kamera auf eine Stelle richten, die sie schon gesehen hat</translation>
    </message>
    <message>
        <source>Relocalised</source>
        <translation>Wieder verortet</translation>
    </message>
    <message>
        <source>&lt;b&gt;Time of the last frame by stage&lt;/b&gt;&lt;table&gt;%1&lt;tr&gt;&lt;td&gt;&lt;b&gt;total&lt;/b&gt;&lt;/td&gt;&lt;td align=&apos;right&apos;&gt;&lt;b&gt;%2 ms&lt;/b&gt;&lt;/td&gt;&lt;/tr&gt;&lt;/table&gt;</source>
        <translation>&lt;b&gt;Zeit des letzten Bildes nach Schritten&lt;/b&gt;&lt;table&gt;%1&lt;tr&gt;&lt;td&gt;&lt;b&gt;gesamt&lt;/b&gt;&lt;/td&gt;&lt;td align=&apos;right&apos;&gt;&lt;b&gt;%2 ms&lt;/b&gt;&lt;/td&gt;&lt;/tr&gt;&lt;/table&gt;</translation>
    </message>
    <message>
        <source>Ready</source>
        <translation>Bereit</translation>
    </message>
    <message>
        <source>Starting…</source>
        <translation>Start…</translation>
    </message>
    <message>
        <source>Scanning</source>
        <translation>Scan läuft</translation>
    </message>
    <message>
        <source>Paused</source>
        <translation>Angehalten</translation>
    </message>
    <message>
        <source>Finishing…</source>
        <translation>Abschluss…</translation>
    </message>
    <message>
        <source>Refining objects</source>
        <translation>Objekte werden verfeinert</translation>
    </message>
    <message>
        <source>Finished</source>
        <translation>Fertig</translation>
    </message>
    <message>
        <source>Failed</source>
        <translation>Gescheitert</translation>
    </message>
    <message>
        <source>Tracking state</source>
        <translation>Stand der Verfolgung</translation>
    </message>
    <message>
        <source>Frames per second</source>
        <translation>Bilder pro Sekunde</translation>
    </message>
    <message>
        <source>Size of the map, and the number of regions in it</source>
        <translation>Größe der Karte und Zahl ihrer Regionen</translation>
    </message>
    <message>
        <source>Frames not used: camera lost, unreadable, or dropped because the camera was faster</source>
        <translation>Nicht benutzte Bilder: Kamera verloren, unlesbar, oder verworfen, weil die Kamera schneller war</translation>
    </message>
    <message>
        <source>The key frames are segmented again at full resolution. Regions split further, unlikely objects and poor views are removed, missed objects are added. You can skip this and do it later.</source>
        <translation>Die Schlüsselbilder werden in voller Auflösung neu segmentiert. Regionen teilen sich weiter, unwahrscheinliche Objekte und schlechte Ansichten entfallen, übersehene Objekte kommen hinzu. Dies lässt sich überspringen und nachholen.</translation>
    </message>
    <message>
        <source>Refining objects: key frame %1 of %2</source>
        <translation>Objekte werden verfeinert: Schlüsselbild %1 von %2</translation>
    </message>
    <message>
        <source>Preparing the OpenCL device (once)</source>
        <translation>OpenCL-Gerät wird vorbereitet (einmalig)</translation>
    </message>
    <message>
        <source>%1   %2   %3 MB</source>
        <translation>%1   %2   %3 MB</translation>
    </message>
    <message numerus="yes">
        <source>%Ln regions</source>
        <translation>
            <numerusform>%Ln Region</numerusform>
            <numerusform>%Ln Regionen</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%Ln bricks</source>
        <translation>
            <numerusform>%Ln Block</numerusform>
            <numerusform>%Ln Blöcke</numerusform>
        </translation>
    </message>
    <message>
        <source>   voxels %1 mm</source>
        <translation>   Voxel %1 mm</translation>
    </message>
    <message>
        <source>The map has voxels of %1 mm</source>
        <translation>Die Karte hat Voxel von %1 mm</translation>
    </message>
    <message>
        <source>%1 lost</source>
        <translation>%1 verloren</translation>
    </message>
    <message>
        <source>%1 unreadable</source>
        <translation>%1 unlesbar</translation>
    </message>
    <message>
        <source>%1 dropped</source>
        <translation>%1 verworfen</translation>
    </message>
    <message>
        <source>no frame lost</source>
        <translation>kein Bild verloren</translation>
    </message>
    <message>
        <source>%1 fps</source>
        <translation>%1 fps</translation>
    </message>
    <message>
        <source>%1 ms per frame:  %2</source>
        <translation>%1 ms je Bild:  %2</translation>
    </message>
</context>
<context>
    <name>scantrove::TimeLine</name>
    <message>
        <source>Key frames</source>
        <translation>Schlüsselbilder</translation>
    </message>
    <message>
        <source>Shown key frame</source>
        <translation>Gezeigtes Schlüsselbild</translation>
    </message>
    <message>
        <source>Browse the stored frames (Page up, Page down). The labels are those of the map now.</source>
        <translation>Die gespeicherten Bilder durchblättern (Bild aufwärts, Bild abwärts). Die Labels sind die der jetzigen Karte.</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Alle</translation>
    </message>
    <message>
        <source>Open</source>
        <translation>Offen</translation>
    </message>
    <message>
        <source>Checked</source>
        <translation>Geprüft</translation>
    </message>
    <message>
        <source>Key frames to browse</source>
        <translation>Schlüsselbilder zum Blättern</translation>
    </message>
    <message>
        <source>Key frames that Page up and Page down go to</source>
        <translation>Schlüsselbilder, zu denen Bild aufwärts und Bild abwärts gehen</translation>
    </message>
    <message>
        <source>%1 of %2 (frame %3)</source>
        <translation>%1 von %2 (Bild %3)</translation>
    </message>
</context>
<context>
    <name>scantrove::ViewActions</name>
    <message>
        <source>&amp;Next colour mode</source>
        <translation>&amp;Nächster Farbmodus</translation>
    </message>
    <message>
        <source>&amp;Clip plane</source>
        <translation>S&amp;chnittebene</translation>
    </message>
    <message>
        <source>&amp;Measure</source>
        <translation>&amp;Messen</translation>
    </message>
    <message>
        <source>Shift+B</source>
        <translation>Shift+B</translation>
    </message>
    <message>
        <source>Show, dim or hide the background</source>
        <translation>Den Hintergrund zeigen, abdunkeln oder verbergen</translation>
    </message>
    <message>
        <source>X</source>
        <translation>X</translation>
    </message>
    <message>
        <source>Hide everything in front of a plane</source>
        <translation>Alles vor einer Ebene verbergen</translation>
    </message>
    <message>
        <source>T</source>
        <translation>T</translation>
    </message>
    <message>
        <source>Measure between two points of the surface</source>
        <translation>Zwischen zwei Punkten der Oberfläche messen</translation>
    </message>
    <message>
        <source>&amp;Scene colours</source>
        <translation>&amp;Szenenfarben</translation>
    </message>
    <message>
        <source>&amp;Regions</source>
        <translation>&amp;Regionen</translation>
    </message>
    <message>
        <source>Scene and regions &amp;blended</source>
        <translation>Szene und Regionen &amp;gemischt</translation>
    </message>
    <message>
        <source>Surface &amp;direction</source>
        <translation>Ober&amp;flächenrichtung</translation>
    </message>
    <message>
        <source>&amp;Height</source>
        <translation>&amp;Höhe</translation>
    </message>
    <message>
        <source>R</source>
        <translation>R</translation>
    </message>
    <message>
        <source>Switch to the next colour mode</source>
        <translation>Zum nächsten Farbmodus wechseln</translation>
    </message>
    <message>
        <source>&amp;Front</source>
        <translation>&amp;Vorn</translation>
    </message>
    <message>
        <source>&amp;Back</source>
        <translation>&amp;Hinten</translation>
    </message>
    <message>
        <source>&amp;Left</source>
        <translation>&amp;Links</translation>
    </message>
    <message>
        <source>&amp;Right</source>
        <translation>&amp;Rechts</translation>
    </message>
    <message>
        <source>&amp;Top</source>
        <translation>&amp;Oben</translation>
    </message>
    <message>
        <source>B&amp;ottom</source>
        <translation>&amp;Unten</translation>
    </message>
    <message>
        <source>Colour &amp;by</source>
        <translation>&amp;Färben nach</translation>
    </message>
    <message>
        <source>&amp;View from</source>
        <translation>Ansicht &amp;von</translation>
    </message>
    <message>
        <source>Colour mode (R: next)</source>
        <translation>Farbmodus (R: nächster)</translation>
    </message>
    <message>
        <source>Colour mode</source>
        <translation>Farbmodus</translation>
    </message>
    <message>
        <source>Background: &amp;shown</source>
        <translation>Hintergrund: &amp;sichtbar</translation>
    </message>
    <message>
        <source>Background: &amp;dimmed</source>
        <translation>Hintergrund: ab&amp;gedunkelt</translation>
    </message>
    <message>
        <source>Background: &amp;hidden</source>
        <translation>Hintergrund: verbor&amp;gen</translation>
    </message>
</context>
<context>
    <name>scantrove::ViewsStrip</name>
    <message>
        <source>Views of the selected object</source>
        <translation>Ansichten des ausgewählten Objekts</translation>
    </message>
    <message>
        <source>Views of the selected object, newest first. The wheel or the arrow keys scroll.</source>
        <translation>Ansichten des ausgewählten Objekts, die neueste zuerst. Mausrad oder Pfeiltasten blättern.</translation>
    </message>
</context>
<context>
    <name>scantrove::WindowDialogs</name>
    <message>
        <source>Folder of a recording</source>
        <translation>Ordner einer Aufnahme</translation>
    </message>
    <message>
        <source>Recording</source>
        <translation>Aufnahme</translation>
    </message>
    <message>
        <source>Recordings, scans, projects (*.oni *.bag *.db3 *.mcap *.mkv *.r3d *.sens session.sqlite scantrove-project.json)</source>
        <translation>Aufnahmen, Scans, Projekte (*.oni *.bag *.db3 *.mcap *.mkv *.r3d *.sens session.sqlite scantrove-project.json)</translation>
    </message>
    <message>
        <source>Catalogue to open or create</source>
        <translation>Katalog zum Öffnen oder Anlegen</translation>
    </message>
    <message>
        <source>Catalogues (*.sqlite)</source>
        <translation>Kataloge (*.sqlite)</translation>
    </message>
    <message>
        <source>Folder of a project</source>
        <translation>Ordner eines Projekts</translation>
    </message>
    <message>
        <source>New folder for the project</source>
        <translation>Neuer Ordner für das Projekt</translation>
    </message>
    <message>
        <source>My objects</source>
        <translation>Meine Objekte</translation>
    </message>
    <message>
        <source>Saved scan</source>
        <translation>Gespeicherter Scan</translation>
    </message>
    <message>
        <source>About Scantrove</source>
        <translation>Über Scantrove</translation>
    </message>
    <message>
        <source>&lt;h3&gt;Scantrove %1&lt;/h3&gt;&lt;p&gt;Scan a scene with an RGB-D camera and collect its objects in a catalogue.&lt;/p&gt;</source>
        <translation>&lt;h3&gt;Scantrove %1&lt;/h3&gt;&lt;p&gt;Eine Szene mit einer RGB-D-Kamera scannen und ihre Objekte in einem Katalog sammeln.&lt;/p&gt;</translation>
    </message>
</context>
</TS>
