// Two boxes that share a face, each a physical volume, and one face a physical surface.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 0.5, 1, 1};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.MeshSizeMin = 2;
Mesh.MeshSizeMax = 2;
Physical Volume("left", 11) = {1};
Physical Volume("right", 5) = {2};
Physical Surface("skin", 3) = {1};
