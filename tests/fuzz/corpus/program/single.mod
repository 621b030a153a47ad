MODULE Blade1
    ! Bladewright: the left end of the blade, for irb1600-10-1.45 in the cell irb1600-pair.
    ! 3 targets, 33.5 s of cutting, blade length 800.00 mm.
    ! Start only with all robots at home: the first move is not synchronised.
    ! confdata is [0,0,0,0] and not verified (ConfL is off): check the axis
    ! configuration, the reach and the way from home on the cell, slowly and cold.
    PERS tasks taskList{1} := [["T_ROB1"]];
    VAR syncident syncHome;
    VAR syncident syncReady;
    VAR syncident syncOn;
    VAR syncident syncOff;
    TASK PERS tooldata tBladeLeft := [TRUE,[[0.0000,0.0000,150.0000],[0.50000000,-0.50000000,-0.50000000,-0.50000000]],[2.5,[0.0000,0.0000,60.0000],[1,0,0,0],0,0,0]];
    TASK PERS wobjdata wBlock := [FALSE,TRUE,"",[[1050.0000,-335.0000,500.0000],[1.00000000,0.00000000,0.00000000,0.00000000]],[[0,0,0],[1,0,0,0]]];
    CONST speeddata vTravel := [200,30,5000,1000];
    CONST speeddata vCut := [20,10,5000,1000];
    CONST jointtarget jtHome := [[-37.2300,25.0300,11.9300,-51.6500,-50.4900,38.8000],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget pApproach := [[-80.0000,-120.0000,145.0000],[0.70357419,-0.70357419,-0.07059289,-0.07059289],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0001 := [[-80.0000,-20.0000,145.0000],[0.70357419,-0.70357419,-0.07059289,-0.07059289],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0002 := [[-69.9023,295.0000,121.7684],[0.67562952,-0.67562952,-0.20862588,-0.20862588],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget p0003 := [[-69.0884,610.0000,95.2502],[0.70130183,-0.70130183,-0.09041981,-0.09041981],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    CONST robtarget pRetreat := [[-69.0884,710.0000,95.2502],[0.70130183,-0.70130183,-0.09041981,-0.09041981],[0,0,0,0],[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]];
    PROC main()
        ConfL \Off;
        SingArea \Off;
        TPWrite "Blade: start only with all robots at home.";
        MoveAbsJ jtHome,vTravel,fine,tBladeLeft\WObj:=wobj0;
        WaitSyncTask syncHome,taskList;
        Set doBladeHeat;
        WaitTime 8;
        WaitSyncTask syncReady,taskList;
        SyncMoveOn syncOn,taskList;
        MoveL pApproach\ID:=10,vTravel\T:=12.6000,fine,tBladeLeft\WObj:=wBlock;
        MoveL p0001\ID:=20,vTravel\T:=0.5000,fine,tBladeLeft\WObj:=wBlock;
        MoveL p0002\ID:=30,vCut\T:=16.7500,z1,tBladeLeft\WObj:=wBlock;
        MoveL p0003\ID:=40,vCut\T:=16.7500,fine,tBladeLeft\WObj:=wBlock;
        MoveL pRetreat\ID:=50,vTravel\T:=0.5000,fine,tBladeLeft\WObj:=wBlock;
        SyncMoveOff syncOff;
        Reset doBladeHeat;
    ENDPROC
ENDMODULE
